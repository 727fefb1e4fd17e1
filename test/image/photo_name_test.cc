// SPDX-FileCopyrightText: 2026 The Plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "plumbline/image/photo_name.h"

#include <gtest/gtest.h>

namespace plumb {
namespace {

TEST(IsPhotoName, IgnoresHiddenTemporaryAndOtherFiles) {
  EXPECT_TRUE(IsPhotoName("DSC_0001.JPG"));
  EXPECT_TRUE(IsPhotoName("a.b.jpeg"));
  EXPECT_TRUE(IsPhotoName("x.tiff"));
  EXPECT_FALSE(IsPhotoName(".DSC_0001.JPG"));
  EXPECT_FALSE(IsPhotoName(".DSC_0001.JPG.xZ9a"));
  EXPECT_FALSE(IsPhotoName("DSC_0001.JPG.part"));
  EXPECT_FALSE(IsPhotoName("DSC_0001.JPG~"));
  EXPECT_FALSE(IsPhotoName("DSC_0001.DNG"));
  EXPECT_FALSE(IsPhotoName("notes.txt"));
  EXPECT_FALSE(IsPhotoName("jpg"));
  EXPECT_FALSE(IsPhotoName(""));
}

}  // namespace
}  // namespace plumb

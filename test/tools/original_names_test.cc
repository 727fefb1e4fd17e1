// SPDX-FileCopyrightText: 2026 The Plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "tools/original_names.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace plumb::tools {
namespace {

StoredPhoto Photo(std::uint32_t id, const std::string& name, const std::string& source_name) {
  StoredPhoto photo;
  photo.id = {id};
  photo.name = name;
  photo.source_name = source_name;
  return photo;
}

// Of the photos with these ids, once they are located.
std::vector<std::string> Names(const std::vector<std::uint32_t>& ids,
                               const std::vector<StoredPhoto>& photos) {
  std::vector<ViewState> views;
  for (const std::uint32_t id : ids) views.push_back({{id}, photos.at(id).name, {}, {}});
  std::vector<std::string> names;
  for (const ViewState& view : WithOriginalNames(views, photos)) names.push_back(view.name);
  return names;
}

TEST(WithOriginalNames, ARepairedPhotoHasTheNameOfTheOneThatWasRefused) {
  const std::vector<StoredPhoto> photos = {Photo(0, "a.jpg", "a.jpg"),
                                           Photo(1, "b.jpg", "DCIM/100MEDIA/b.jpg"),
                                           Photo(2, "a_2.jpg", "a.jpg")};
  EXPECT_THAT(Names({1, 2}, photos), testing::ElementsAre("b.jpg", "a.jpg"));
}

TEST(WithOriginalNames, PhotosOfOneNameThatAreBothLocatedKeepTheSessionsNames) {
  const std::vector<StoredPhoto> photos = {Photo(0, "a.jpg", "100MEDIA/a.jpg"),
                                           Photo(1, "101MEDIA_a.jpg", "101MEDIA/a.jpg"),
                                           Photo(2, "c_2.jpg", "c.jpg")};
  EXPECT_THAT(Names({0, 1, 2}, photos), testing::ElementsAre("a.jpg", "101MEDIA_a.jpg", "c.jpg"));
}

}  // namespace
}  // namespace plumb::tools

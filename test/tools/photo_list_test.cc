// SPDX-FileCopyrightText: 2026 The Plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "tools/photo_list.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <stdexcept>

namespace plumb::tools {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using Names = std::vector<std::string>;

TEST(NaturallyLess, ComparesRunsOfDigitsAsNumbers) {
  const Names sorted = {"1.jpg",
                        "01.jpg",
                        "2.jpg",
                        "10.jpg",
                        "DSC_9.jpg",
                        "DSC_10.jpg",
                        "DSC_10a.jpg",
                        "DSC_123456789012345678901234567890.jpg"};
  Names names(sorted.rbegin(), sorted.rend());
  std::sort(names.begin(), names.end(), NaturallyLess);
  // 1 and 01 are the same number; which comes first is settled by their characters.
  EXPECT_THAT(Names(names.begin() + 2, names.end()),
              testing::ElementsAreArray(sorted.begin() + 2, sorted.end()));
}

TEST(NaturallyLess, IsAStrictOrder) {
  const Names names = {"", "a", "a1", "a01", "a001b", "a1b", "b", "1", "00", "0", "a0"};
  for (const std::string& a : names) {
    EXPECT_FALSE(NaturallyLess(a, a)) << a;
    for (const std::string& b : names) {
      if (a == b) continue;
      EXPECT_NE(NaturallyLess(a, b), NaturallyLess(b, a)) << a << " " << b;
    }
  }
}

TEST(ApplyOrder, TurnsAndShufflesReproducibly) {
  const Names names = {"a", "b", "c", "d", "e", "f", "g", "h"};
  Names by_name = names;
  ApplyOrder("name", &by_name);
  EXPECT_EQ(by_name, names);
  Names reversed = names;
  ApplyOrder("reverse", &reversed);
  EXPECT_EQ(reversed, Names(names.rbegin(), names.rend()));
  Names first = names;
  ApplyOrder("shuffle:1", &first);
  Names again = names;
  ApplyOrder("shuffle:1", &again);
  Names other = names;
  ApplyOrder("shuffle:2", &other);
  EXPECT_EQ(first, again);
  EXPECT_NE(first, names);
  EXPECT_NE(first, other);
  EXPECT_THAT(first, testing::UnorderedElementsAreArray(names));
}

TEST(ApplyOrder, RefusesWhatIsNoOrder) {
  for (const char* order : {"", "random", "shuffle", "shuffle:", "shuffle:x", "shuffle:-1"}) {
    Names names = {"a"};
    EXPECT_THROW(ApplyOrder(order, &names), std::runtime_error) << order;
  }
}

TEST(ListPhotos, GivesFilesInNaturalOrderWithoutFoldersAndHiddenFiles) {
  std::string pattern = testing::TempDir() + "photo_list_XXXXXX";
  const std::filesystem::path folder = ::mkdtemp(pattern.data());
  for (const char* name : {"p10.jpg", "p9.jpg", ".hidden.jpg", "notes.txt"}) {
    std::ofstream(folder / name) << "x";
  }
  std::filesystem::create_directory(folder / "p1");
  EXPECT_THAT(ListPhotos(folder.string()), ElementsAre("notes.txt", "p9.jpg", "p10.jpg"));
  std::filesystem::remove_all(folder);
}

TEST(ListPhotos, NamesAnEmptyOrAbsentFolder) {
  std::string pattern = testing::TempDir() + "photo_list_XXXXXX";
  const std::filesystem::path folder = ::mkdtemp(pattern.data());
  for (const std::filesystem::path& path : {folder, folder / "absent"}) {
    try {
      ListPhotos(path.string());
      ADD_FAILURE() << "must throw";
    } catch (const std::runtime_error& error) {
      EXPECT_THAT(error.what(), HasSubstr(path.string()));
    }
  }
  std::filesystem::remove_all(folder);
}

}  // namespace
}  // namespace plumb::tools

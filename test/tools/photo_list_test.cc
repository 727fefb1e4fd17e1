// SPDX-FileCopyrightText: 2026 The Plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "tools/photo_list.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/stat.h>

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

class ListPhotosTest : public testing::Test {
 protected:
  ListPhotosTest() {
    std::string pattern = testing::TempDir() + "photo_list_XXXXXX";
    folder_ = ::mkdtemp(pattern.data());
  }
  ~ListPhotosTest() override { std::filesystem::remove_all(folder_); }

  void Write(const std::string& name) {
    std::filesystem::create_directories((folder_ / name).parent_path());
    std::ofstream(folder_ / name) << "x";
  }
  PhotoListing List() const { return ListPhotos(folder_.string()); }
  std::string ErrorOf(const std::filesystem::path& folder) const {
    try {
      ListPhotos(folder.string());
    } catch (const std::runtime_error& error) {
      return error.what();
    }
    return {};
  }

  std::filesystem::path folder_;
};

TEST_F(ListPhotosTest, GivesPhotosInNaturalOrderAndSaysWhatItSkipped) {
  for (const char* name :
       {"p10.JPG", "p9.jpg", ".DS_Store", "._p9.jpg", "a.MP4", "b.mp4", "x.SRT", "README"}) {
    Write(name);
  }
  const PhotoListing listing = List();
  EXPECT_THAT(listing.photos, ElementsAre("p9.jpg", "p10.JPG"));
  EXPECT_THAT(Describe(listing),
              ElementsAre("skipped, no photos by their names (JPEG, PNG, TIFF and BMP are "
                          "read): 2 .mp4, 1 .srt, 2 hidden, 1 without an extension"));
}

TEST_F(ListPhotosTest, SearchesSubfoldersButNoHiddenOnesLinksAndSessions) {
  for (const char* name : {"DCIM/100MEDIA/b2.jpg",
                           "DCIM/100MEDIA/b10.jpg",
                           "DCIM/101MEDIA/a.jpg",
                           ".thumbnails/a.jpg",
                           "session/session.db",
                           "session/photos/a.jpg",
                           "c.jpg"}) {
    Write(name);
  }
  std::filesystem::create_directory_symlink(folder_, folder_ / "loop");
  const PhotoListing listing = List();
  EXPECT_THAT(
      listing.photos,
      ElementsAre("DCIM/100MEDIA/b2.jpg", "DCIM/100MEDIA/b10.jpg", "DCIM/101MEDIA/a.jpg", "c.jpg"));
  const Names lines = Describe(listing);
  ASSERT_EQ(lines.size(), 2U);
  EXPECT_EQ(lines[0], "photos in sub-folders: DCIM/100MEDIA/ (2), DCIM/101MEDIA/ (1)");
  EXPECT_EQ(lines[1], "folders not searched: 1 hidden, 1 linked, 1 with a session");
}

TEST_F(ListPhotosTest, ListsALinkThatLeadsNowhereButNoPipe) {
  std::filesystem::create_symlink(folder_ / "gone", folder_ / "a.jpg");
  ASSERT_EQ(::mkfifo((folder_ / "pipe.jpg").c_str(), 0600), 0);
  EXPECT_THAT(List().photos, ElementsAre("a.jpg"));
}

TEST_F(ListPhotosTest, NamesAnAbsentFolderAndOneWithoutPhotos) {
  const std::filesystem::path absent = folder_ / "absent";
  EXPECT_THAT(ErrorOf(absent), HasSubstr(absent.string()));
  EXPECT_THAT(ErrorOf(folder_), HasSubstr(folder_.string() + ": holds no photo"));
  Write("film.mp4");
  Write("flight/session.db");
  EXPECT_THAT(ErrorOf(folder_), HasSubstr("only 1 .mp4; folders not searched: 1 with a session"));
}

}  // namespace
}  // namespace plumb::tools

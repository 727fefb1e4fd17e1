// SPDX-FileCopyrightText: 2026 The Plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "plumbline/common/atomic_file.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>
#include <stdexcept>

namespace plumb {
namespace {

using testing::HasSubstr;

class AtomicFile : public testing::Test {
 protected:
  AtomicFile() {
    std::string pattern = testing::TempDir() + "atomic_file_XXXXXX";
    folder_ = ::mkdtemp(pattern.data());
  }
  ~AtomicFile() override { std::filesystem::remove_all(folder_); }

  std::size_t NumFiles() const {
    return static_cast<std::size_t>(std::distance(std::filesystem::directory_iterator(folder_),
                                                  std::filesystem::directory_iterator()));
  }

  std::filesystem::path folder_;
};

TEST_F(AtomicFile, ReadsBackWhatWasWrittenAndLeavesNothingElse) {
  const std::string path = (folder_ / "photo.jpg").string();
  const std::string bytes("\0\xff\r\n middle \0 end", 17);
  WriteFileAtomically(path, bytes);
  const std::vector<std::uint8_t> read = ReadFileBytes(path);
  EXPECT_EQ(std::string(read.begin(), read.end()), bytes);
  EXPECT_EQ(NumFiles(), 1u);
}

TEST_F(AtomicFile, ReplacesAFileAndWritesAnEmptyOne) {
  const std::string path = (folder_ / "report.json").string();
  WriteFileAtomically(path, std::string(100000, 'a'));
  WriteFileAtomically(path, std::string());
  EXPECT_TRUE(ReadFileBytes(path).empty());
  EXPECT_EQ(NumFiles(), 1u);
}

TEST_F(AtomicFile, AFailureNamesTheFileAndLeavesNothingBehind) {
  const std::string path = (folder_ / "taken").string();
  std::filesystem::create_directory(path);  // A file cannot be renamed onto a folder.
  try {
    WriteFileAtomically(path, "text");
    FAIL() << "must throw";
  } catch (const std::runtime_error& error) {
    EXPECT_THAT(error.what(), HasSubstr(path));
  }
  EXPECT_EQ(NumFiles(), 1u);
  EXPECT_THROW(WriteFileAtomically((folder_ / "absent/file").string(), "text"), std::runtime_error);
}

TEST_F(AtomicFile, WhetherItCanBeWrittenIsToldBeforeAsAfter) {
  const auto told = [](const std::string& path, auto write) -> std::string {
    try {
      write(path);
    } catch (const std::runtime_error& error) {
      return error.what();
    }
    return {};
  };
  const auto require = [](const std::string& path) { RequireWritable(path); };
  const auto write = [](const std::string& path) { WriteFileAtomically(path, "text"); };
  EXPECT_EQ(told(folder_ / "new", require), "");
  EXPECT_EQ(NumFiles(), 0u);
  write(folder_ / "file");
  EXPECT_EQ(told(folder_ / "file", require), "");
  for (const char* name : {"absent/file", "file/file"}) {
    const std::string before = told(folder_ / name, require);
    EXPECT_THAT(before, HasSubstr("cannot create"));
    EXPECT_EQ(before, told(folder_ / name, write));
  }
  EXPECT_THAT(told(folder_, require), HasSubstr("is a folder"));
}

TEST_F(AtomicFile, ReadingWhatIsAbsentOrAFolderNamesIt) {
  for (const std::filesystem::path& path : {folder_ / "absent.jpg", folder_}) {
    try {
      ReadFileBytes(path.string());
      FAIL() << "must throw";
    } catch (const std::runtime_error& error) {
      EXPECT_THAT(error.what(), HasSubstr(path.string()));
    }
  }
}

}  // namespace
}  // namespace plumb

// SPDX-FileCopyrightText: 2026 The Plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "ros/live_mapper.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/resource.h>

#include <condition_variable>
#include <csignal>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>

#include "test/ros/temporary_folder.h"

namespace plumb::ros_adapter {
namespace {

using ::testing::HasSubstr;

constexpr std::chrono::seconds kDeadline{60};

// While it lives, no file of this process can be written beyond its first byte: to SQLite and to us
// a disk that refuses to write.
class RefusingDisk {
 public:
  RefusingDisk() : old_handler_(std::signal(SIGXFSZ, SIG_IGN)) {
    getrlimit(RLIMIT_FSIZE, &old_limit_);
    const rlimit limit{1, old_limit_.rlim_max};
    setrlimit(RLIMIT_FSIZE, &limit);
  }
  ~RefusingDisk() {
    setrlimit(RLIMIT_FSIZE, &old_limit_);
    std::signal(SIGXFSZ, old_handler_);
  }

  RefusingDisk(const RefusingDisk&) = delete;
  RefusingDisk& operator=(const RefusingDisk&) = delete;

 private:
  rlimit old_limit_{};
  void (*old_handler_)(int);
};

// What a LiveMapper said.
class Heard {
 public:
  LiveMapperOutput MakeOutput() {
    LiveMapperOutput output;
    output.on_verdict = [this](const PhotoVerdict&, const PhotoBytes&) {
      Note([this] { ++num_verdicts_; });
    };
    output.on_map_delta = [](const MapDelta&) {};
    output.on_stored = [this](const std::vector<std::uint32_t>& sequences) {
      Note([&] { num_stored_ = sequences.size(); });
    };
    output.on_storage_trouble = [this](const std::string& trouble, std::size_t num_waiting) {
      Note([&] {
        troubles_.push_back(trouble);
        num_waiting_ = num_waiting;
      });
    };
    return output;
  }

  bool WaitForVerdicts(std::size_t num) {
    return Wait([this, num] { return num_verdicts_ >= num; });
  }
  bool WaitForStored(std::size_t num) {
    return Wait([this, num] { return num_stored_ >= num; });
  }
  bool WaitForTrouble(bool is_there) {
    return Wait([=] { return !troubles_.empty() && troubles_.back().empty() != is_there; });
  }
  std::size_t num_waiting() {
    const std::lock_guard<std::mutex> lock(mutex_);
    return num_waiting_;
  }

 private:
  void Note(const std::function<void()>& change) {
    const std::lock_guard<std::mutex> lock(mutex_);
    change();
    changed_.notify_all();
  }
  bool Wait(const std::function<bool()>& condition) {
    std::unique_lock<std::mutex> lock(mutex_);
    return changed_.wait_for(lock, kDeadline, condition);
  }

  std::mutex mutex_;
  std::condition_variable changed_;
  std::size_t num_verdicts_ = 0;
  std::size_t num_stored_ = 0;
  std::vector<std::string> troubles_;
  std::size_t num_waiting_ = 0;
};

class LiveMapperTest : public ::testing::Test {
 protected:
  static Camera MakeCamera() {
    const LensParameters<double> lens{60.0, 60.0, 31.5, 23.5};
    return Camera("tiny", 64, 48, DistortionModel::kPlumbBob, lens);
  }

  std::unique_ptr<LiveMapper> MakeLiveMapper() {
    return std::make_unique<LiveMapper>(
        MapperOptions(), session_.path(), MakeCamera(), /*max_queue=*/16, heard_.MakeOutput());
  }

  // A file that is no photo gets a verdict like any other.
  static WirePhoto MakePhoto(std::uint32_t id) {
    WirePhoto photo;
    photo.id = PhotoId{id};
    photo.name = std::to_string(id) + ".jpg";
    photo.bytes = {'n', 'o', static_cast<std::uint8_t>(id)};
    return photo;
  }

  std::size_t NumReported() const {
    return nlohmann::json::parse(std::ifstream(session_ / "report.json")).at("photos").size();
  }

  TemporaryFolder session_;
  Heard heard_;
};

TEST_F(LiveMapperTest, FinishReportsAllPhotosOfferedBefore) {
  const auto live = MakeLiveMapper();
  for (std::uint32_t id = 1; id <= 10; ++id) EXPECT_TRUE(live->Offer(MakePhoto(id)));
  EXPECT_EQ(live->Finish(), "");
  EXPECT_EQ(NumReported(), 10U);
}

TEST_F(LiveMapperTest, FinishSaysWhyItCannotWhileTheDiskRefusesAndCanAfterwards) {
  const auto live = MakeLiveMapper();
  ASSERT_TRUE(live->Offer(MakePhoto(1)));
  ASSERT_EQ(live->Finish(), "");
  {
    const RefusingDisk disk;
    for (std::uint32_t id = 2; id <= 4; ++id) EXPECT_TRUE(live->Offer(MakePhoto(id)));
    EXPECT_TRUE(heard_.WaitForVerdicts(4));  // Verdicts do not wait for the disk.
    EXPECT_TRUE(heard_.WaitForTrouble(true));
    EXPECT_THAT(live->Finish(), HasSubstr(session_.path()));
    EXPECT_EQ(heard_.num_waiting(), 3U);
  }
  EXPECT_TRUE(heard_.WaitForStored(4));
  EXPECT_TRUE(heard_.WaitForTrouble(false));
  EXPECT_EQ(live->Finish(), "");
  EXPECT_EQ(NumReported(), 4U);
  EXPECT_EQ(SessionStore::OpenExisting(session_.path()).LatestVerdicts().size(), 4U);
}

TEST_F(LiveMapperTest, EndsWhileTheDiskRefuses) {
  auto live = MakeLiveMapper();
  const RefusingDisk disk;
  ASSERT_TRUE(live->Offer(MakePhoto(1)));
  EXPECT_TRUE(heard_.WaitForTrouble(true));
  live.reset();
}

TEST_F(LiveMapperTest, GoesOnWithTheVerdictsItFinds) {
  {
    const auto live = MakeLiveMapper();
    EXPECT_TRUE(live->Offer(MakePhoto(7)));
    ASSERT_EQ(live->Finish(), "");
  }
  const auto live = MakeLiveMapper();
  ASSERT_EQ(live->verdicts().size(), 1U);
  EXPECT_EQ(live->verdicts().begin()->first, PhotoId{7});
}

}  // namespace
}  // namespace plumb::ros_adapter

// SPDX-FileCopyrightText: 2026 The Plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "ros/flight_bag.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <plumbline/Photo.h>
#include <rosbag/bag.h>
#include <rosbag/view.h>

#include <filesystem>
#include <stdexcept>

#include "plumbline/common/atomic_file.h"
#include "ros/camera_conversion.h"
#include "ros/photo_conversion.h"
#include "ros/position_conversion.h"
#include "test/support/synthetic_scene.h"

namespace plumb::ros_adapter {
namespace {

namespace fs = std::filesystem;

class FlightBagTest : public testing::Test {
 protected:
  FlightBagTest() {
    fs::remove_all(root_);
    fs::create_directories(root_);
    for (const std::string name : {"0001.jpg", "0002.jpg"}) {
      WriteFileAtomically(root_ + '/' + name, "\xFF\xD8" + name);
      photos_.push_back({name,
                         root_ + '/' + name,
                         Timestamp{1'717'236'005'000'000'000 + 1000 * (name[3] - '0')},
                         GeodeticPosition{47.0, 15.0, 420.0}});
    }
  }

  std::string root_ = testing::TempDir() + "/flight_bag_test";
  Camera camera_ = test::MakeCamera(-0.1);
  std::vector<tools::RecordedPhoto> photos_;
};

TEST_F(FlightBagTest, HoldsThePhotosAsCameraIngestSendsThem) {
  WriteFlightBag(root_ + "/flight.bag", camera_, photos_);
  rosbag::Bag bag(root_ + "/flight.bag");
  std::size_t num_messages = 0;
  for (const rosbag::MessageInstance& message :
       rosbag::View(bag, rosbag::TopicQuery("/plumbline/photo"))) {
    const auto msg = message.instantiate<plumbline::Photo>();
    ASSERT_TRUE(msg);
    const std::optional<WirePhoto> photo = FromPhotoMsg(*msg);
    ASSERT_TRUE(photo);
    const tools::RecordedPhoto& recorded = photos_[num_messages++];
    EXPECT_EQ(photo->id.value, num_messages);
    EXPECT_EQ(photo->name, recorded.name);
    EXPECT_EQ(photo->exposure_time, recorded.exposure_time);
    EXPECT_EQ(photo->position->lat_deg, 47.0);
    EXPECT_EQ(photo->bytes, ReadFileBytes(recorded.file));
    EXPECT_TRUE(IsSameCamera(FromCameraInfoMsg(msg->camera_info, "bag"), camera_));
  }
  EXPECT_EQ(num_messages, photos_.size());
}

TEST_F(FlightBagTest, SaysBeforeThemWhereTheyWereTaken) {
  photos_[0].position.reset();
  WriteFlightBag(root_ + "/flight.bag", camera_, photos_);
  rosbag::Bag bag(root_ + "/flight.bag");
  rosbag::View all(bag);
  EXPECT_EQ(all.size(), 3U);
  const rosbag::MessageInstance first = *all.begin();
  EXPECT_EQ(first.getTopic(), "/plumbline/photo_positions");
  EXPECT_TRUE(first.isLatching());
  const auto msg = first.instantiate<plumbline::PhotoPositions>();
  ASSERT_TRUE(msg);
  const auto positions = FromPhotoPositionsMsg(*msg);
  ASSERT_TRUE(positions && positions->camera);
  EXPECT_TRUE(IsSameCamera(*positions->camera, camera_));
  ASSERT_EQ(positions->position_of_photo.size(), 1U);
  EXPECT_EQ(positions->position_of_photo.at(PhotoId{2}).alt_m, 420.0);
}

TEST_F(FlightBagTest, IsTheSameEachTime) {
  WriteFlightBag(root_ + "/a.bag", camera_, photos_);
  WriteFlightBag(root_ + "/b.bag", camera_, photos_);
  EXPECT_EQ(ReadFileBytes(root_ + "/a.bag"), ReadFileBytes(root_ + "/b.bag"));
}

TEST_F(FlightBagTest, LeavesNothingHalfWritten) {
  photos_[1].file = root_ + "/gone.jpg";
  try {
    WriteFlightBag(root_ + "/flight.bag", camera_, photos_);
    FAIL();
  } catch (const std::runtime_error& error) {
    EXPECT_THAT(error.what(), testing::HasSubstr("gone.jpg"));
  }
  EXPECT_FALSE(fs::exists(root_ + "/flight.bag"));
  EXPECT_FALSE(fs::exists(root_ + "/flight.bag.unfinished"));
}

}  // namespace
}  // namespace plumb::ros_adapter

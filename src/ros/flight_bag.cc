// SPDX-FileCopyrightText: 2026 The Plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "ros/flight_bag.h"

#include <rosbag/bag.h>

#include <boost/make_shared.hpp>
#include <cstdint>
#include <filesystem>
#include <stdexcept>

#include "plumbline/common/atomic_file.h"
#include "ros/camera_conversion.h"
#include "ros/geometry_conversion.h"
#include "ros/photo_conversion.h"
#include "ros/position_conversion.h"

namespace plumb::ros_adapter {
namespace {

namespace fs = std::filesystem;

constexpr char kPhotoTopic[] = "/plumbline/photo";
constexpr char kPositionsTopic[] = "/plumbline/photo_positions";
constexpr char kCameraFrame[] = "camera_optical";

// From the exposure until the photo is off the camera's card, and until it was read and sent.
constexpr std::int64_t kTransfer_ns = 400'000'000;
constexpr std::int64_t kSend_ns = 20'000'000;

// With the first photo: all of them at once.
void WritePositions(const Camera& camera,
                    const std::vector<tools::RecordedPhoto>& photos,
                    rosbag::Bag* bag) {
  if (photos.empty()) return;
  PhotoPositions positions;
  positions.camera = camera;
  for (std::size_t i = 0; i < photos.size(); ++i) {
    if (!photos[i].position) continue;
    positions.position_of_photo[PhotoId{static_cast<std::uint32_t>(i + 1)}] = *photos[i].position;
  }
  std_msgs::Header header;
  header.frame_id = kCameraFrame;
  header.stamp = ToRosTime({photos[0].exposure_time.ns + kTransfer_ns});
  using Message = plumbline::PhotoPositions;
  const auto connection = boost::make_shared<ros::M_string>(
      ros::M_string{{"topic", kPositionsTopic},
                    {"type", ros::message_traits::datatype<Message>()},
                    {"md5sum", ros::message_traits::md5sum<Message>()},
                    {"message_definition", ros::message_traits::definition<Message>()},
                    {"latching", "1"}});
  bag->write(kPositionsTopic, header.stamp, ToPhotoPositionsMsg(positions, header), connection);
}

void WritePhotos(const std::string& path,
                 const Camera& camera,
                 const std::vector<tools::RecordedPhoto>& photos) {
  const sensor_msgs::CameraInfo camera_info = ToCameraInfoMsg(camera);
  rosbag::Bag bag(path, rosbag::bagmode::Write);
  WritePositions(camera, photos, &bag);
  for (std::size_t i = 0; i < photos.size(); ++i) {
    WirePhoto photo;
    photo.id = PhotoId{static_cast<std::uint32_t>(i + 1)};
    photo.name = photos[i].name;
    photo.exposure_time = photos[i].exposure_time;
    photo.position = photos[i].position;
    photo.received = {photo.exposure_time.ns + kTransfer_ns};
    photo.published = {photo.received.ns + kSend_ns};
    photo.bytes = ReadFileBytes(photos[i].file);
    bag.write(
        kPhotoTopic, ToRosTime(photo.published), ToPhotoMsg(photo, camera_info, kCameraFrame));
  }
  bag.close();
}

}  // namespace

void WriteFlightBag(const std::string& path,
                    const Camera& camera,
                    const std::vector<tools::RecordedPhoto>& photos) {
  const std::string unfinished = path + ".unfinished";
  try {
    WritePhotos(unfinished, camera, photos);
    fs::rename(unfinished, path);
  } catch (const std::exception& error) {
    std::error_code ignored;
    fs::remove(unfinished, ignored);
    throw std::runtime_error(path + ": cannot write the bag: " + error.what() +
                             "; free some space on this disk, or give --no-bag");
  }
}

}  // namespace plumb::ros_adapter

// SPDX-FileCopyrightText: 2026 The Plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "ros/unsearched_photos.h"

#include <filesystem>
#include <stdexcept>
#include <system_error>
#include <utility>

#include "plumbline/camera/camera.h"
#include "plumbline/common/atomic_file.h"
#include "ros/camera_conversion.h"
#include "ros/photo_conversion.h"

namespace plumb::ros_adapter {
namespace {

constexpr char kCameraFrame[] = "camera_optical";

}  // namespace

UnsearchedPhotos::UnsearchedPhotos(std::string session_folder)
    : session_folder_(std::move(session_folder)) {}

std::optional<plumbline::Photo> UnsearchedPhotos::Next(
    const std::function<bool(std::uint32_t)>& is_known) {
  // Which comes with the first camera_info, if it comes over a topic.
  if (!std::filesystem::exists(session_folder_ + "/camera.yaml")) return std::nullopt;
  const Camera camera = ReadCameraYaml(session_folder_ + "/camera.yaml");  // May be mended yet.
  ReadLedger();
  for (const TakenPhoto& photo : photos_) {
    if (unreadable_.count(photo.sequence) != 0 || is_known(photo.sequence)) continue;
    try {
      return Read(photo, camera);
    } catch (const std::runtime_error&) {
      unreadable_.insert(photo.sequence);
      throw;
    }
  }
  return std::nullopt;
}

// Lines are only ever added to it.
void UnsearchedPhotos::ReadLedger() {
  std::error_code error;
  const std::uintmax_t size = std::filesystem::file_size(session_folder_ + "/photos.jsonl", error);
  if (error || size == ledger_size_) return;
  photos_ = ReadPhotoLedger(session_folder_);
  ledger_size_ = size;
}

plumbline::Photo UnsearchedPhotos::Read(const TakenPhoto& photo, const Camera& camera) const {
  WirePhoto wire;
  wire.id = PhotoId{photo.sequence};
  wire.name = photo.name;
  wire.exposure_time = photo.exposure_time;
  wire.position = photo.position;
  wire.received = photo.received;
  wire.published = photo.received;
  wire.bytes = ReadFileBytes(session_folder_ + "/photos/" + photo.name);
  return ToPhotoMsg(wire, ToCameraInfoMsg(camera), kCameraFrame);
}

}  // namespace plumb::ros_adapter

// SPDX-FileCopyrightText: 2026 The Plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "ros/photo_intake.h"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <chrono>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <stdexcept>

#include "plumbline/common/atomic_file.h"
#include "plumbline/common/check.h"
#include "plumbline/image/photo_metadata.h"
#include "ros/geometry_conversion.h"

namespace plumb::ros_adapter {
namespace {

using nlohmann::json;

Timestamp Now() {
  return {std::chrono::duration_cast<std::chrono::nanoseconds>(
              std::chrono::system_clock::now().time_since_epoch())
              .count()};
}

json ToJson(const TakenPhoto& photo) {
  json line = {{"sequence", photo.sequence},
               {"name", photo.name},
               {"source", photo.source},
               {"source_time_ns", photo.source_time.ns},
               {"exposure_time_ns", photo.exposure_time.ns},
               {"received_ns", photo.received.ns}};
  if (!photo.position) return line;
  line["lat_deg"] = photo.position->lat_deg;
  line["lon_deg"] = photo.position->lon_deg;
  if (photo.position->alt_m) line["alt_m"] = *photo.position->alt_m;
  return line;
}

// Throws json::exception if a field is missing or of another type.
TakenPhoto FromJson(const json& line) {
  TakenPhoto photo;
  photo.sequence = line.at("sequence").get<std::uint32_t>();
  photo.name = line.at("name").get<std::string>();
  photo.source = line.at("source").get<std::string>();
  photo.source_time.ns = line.at("source_time_ns").get<std::int64_t>();
  photo.exposure_time.ns = line.at("exposure_time_ns").get<std::int64_t>();
  photo.received.ns = line.at("received_ns").get<std::int64_t>();
  if (!line.contains("lat_deg")) return photo;
  GeodeticPosition& position = photo.position.emplace();
  position.lat_deg = line.at("lat_deg").get<double>();
  position.lon_deg = line.at("lon_deg").get<double>();
  if (line.contains("alt_m")) position.alt_m = line.at("alt_m").get<double>();
  return photo;
}

[[noreturn]] void FailToWrite(const std::string& path, int error) {
  const bool is_full = error == ENOSPC || error == EDQUOT;
  throw std::runtime_error(
      path + ": cannot be written: " + std::strerror(error) +
      (is_full ? "; free some space on this disk" : "; make it and its folder writable"));
}

Timestamp TimeOfChange(const std::string& path) {
  struct stat status {};
  if (stat(path.c_str(), &status) != 0) {
    throw UnreadablePhoto(path + ": cannot be read: " + std::strerror(errno));
  }
  return {status.st_mtim.tv_sec * 1'000'000'000LL + status.st_mtim.tv_nsec};
}

std::vector<std::uint8_t> ReadPhoto(const std::string& path) {
  try {
    return ReadFileBytes(path);
  } catch (const std::runtime_error& error) {
    throw UnreadablePhoto(error.what());
  }
}

// Appends and waits until the disk has it.
void AppendDurably(const std::string& path, const std::string& text) {
  const int file = open(path.c_str(), O_WRONLY | O_CREAT | O_APPEND | O_CLOEXEC, 0644);
  if (file < 0) FailToWrite(path, errno);
  const ssize_t num_written = write(file, text.data(), text.size());
  int error = 0;
  if (num_written < 0 || fdatasync(file) != 0) {
    error = errno;
  } else if (num_written < static_cast<ssize_t>(text.size())) {
    error = ENOSPC;
  }
  if (close(file) != 0 && error == 0) error = errno;
  if (error != 0) FailToWrite(path, error);
}

std::string LedgerPath(const std::string& session_folder) {
  return session_folder + "/photos.jsonl";
}

struct Ledger {
  std::vector<TakenPhoto> photos;
  std::size_t whole_size = 0;  // Of the lines that are whole [bytes].
  std::size_t size = 0;
};

Ledger ReadLedgerFile(const std::string& path) {
  Ledger ledger;
  if (!std::filesystem::exists(path)) return ledger;
  const std::vector<std::uint8_t> bytes = ReadFileBytes(path);
  const std::string text(bytes.begin(), bytes.end());
  ledger.size = text.size();
  for (int line_number = 1; ledger.whole_size < text.size(); ++line_number) {
    const std::size_t end = text.find('\n', ledger.whole_size);
    if (end == std::string::npos) break;
    try {
      const std::string line = text.substr(ledger.whole_size, end - ledger.whole_size);
      ledger.photos.push_back(FromJson(json::parse(line)));
    } catch (const json::exception& error) {
      throw std::runtime_error(path + ", line " + std::to_string(line_number) +
                               ", makes no sense: " + error.what());
    }
    ledger.whole_size = end + 1;
  }
  return ledger;
}

}  // namespace

std::vector<TakenPhoto> ReadPhotoLedger(const std::string& session_folder) {
  return ReadLedgerFile(LedgerPath(session_folder)).photos;
}

PhotoIntake::PhotoIntake(const std::string& session_folder)
    : ledger_path_(LedgerPath(session_folder)), folder_(session_folder + "/photos") {
  folder_.Prepare();
  ReadLedger();
}

void PhotoIntake::ReadLedger() {
  const Ledger ledger = ReadLedgerFile(ledger_path_);
  for (const TakenPhoto& photo : ledger.photos) {
    photos_[photo.sequence] = photo;
    sequence_of_name_[photo.name] = photo.sequence;
  }
  if (ledger.whole_size < ledger.size) {
    std::filesystem::resize_file(ledger_path_, ledger.whole_size);
  }
}

std::optional<TakenPhoto> PhotoIntake::TakeFile(const std::string& folder,
                                                const std::string& source) {
  const std::string path = folder + '/' + source;
  const Timestamp changed = TimeOfChange(path);
  if (IsKnown(source, changed)) return std::nullopt;
  const std::vector<std::uint8_t> bytes = ReadPhoto(path);
  return Take(source, changed, ReadPhotoMetadata(bytes).exposure_time.value_or(changed), bytes);
}

std::optional<TakenPhoto> PhotoIntake::TakeBytes(const std::string& source,
                                                 Timestamp time,
                                                 const std::vector<std::uint8_t>& bytes) {
  return Take(source, time, time, bytes);
}

std::optional<TakenPhoto> PhotoIntake::Take(const std::string& source,
                                            Timestamp source_time,
                                            Timestamp exposure_time,
                                            const std::vector<std::uint8_t>& bytes) {
  TakenPhoto photo;
  photo.received = Now();
  photo.source = source;
  photo.source_time = source_time;
  photo.exposure_time = FitsRosTime(exposure_time) ? exposure_time : photo.received;
  photo.position = ReadPhotoMetadata(bytes).position;
  photo.name = folder_.Save(source, bytes);

  const std::lock_guard<std::mutex> lock(mutex_);
  if (sequence_of_name_.count(photo.name) != 0) return std::nullopt;
  photo.sequence = photos_.empty() ? 1 : photos_.rbegin()->first + 1;
  Append(photo);
  return photo;
}

bool PhotoIntake::IsKnown(const std::string& source, Timestamp source_time) const {
  const std::lock_guard<std::mutex> lock(mutex_);
  for (const auto& [sequence, photo] : photos_) {
    if (photo.source == source && photo.source_time == source_time) return true;
  }
  return false;
}

void PhotoIntake::Append(const TakenPhoto& photo) {
  // A failed write must not leave half a line.
  const std::uintmax_t size =
      std::filesystem::exists(ledger_path_) ? std::filesystem::file_size(ledger_path_) : 0;
  try {
    AppendDurably(ledger_path_, ToJson(photo).dump() + '\n');
  } catch (const std::runtime_error&) {
    std::error_code ignored;
    std::filesystem::resize_file(ledger_path_, size, ignored);
    throw;
  }
  photos_[photo.sequence] = photo;
  sequence_of_name_[photo.name] = photo.sequence;
}

std::size_t PhotoIntake::num_photos() const {
  const std::lock_guard<std::mutex> lock(mutex_);
  return photos_.size();
}

std::vector<TakenPhoto> PhotoIntake::photos() const {
  const std::lock_guard<std::mutex> lock(mutex_);
  std::vector<TakenPhoto> photos;
  for (const auto& [sequence, photo] : photos_) photos.push_back(photo);
  return photos;
}

TakenPhoto PhotoIntake::photo(std::uint32_t sequence) const {
  const std::lock_guard<std::mutex> lock(mutex_);
  const auto it = photos_.find(sequence);
  PLUMB_CHECK(it != photos_.end());
  return it->second;
}

std::vector<std::uint8_t> PhotoIntake::ReadBytes(const TakenPhoto& photo) const {
  return ReadFileBytes(folder_.PathOf(photo.name));
}

}  // namespace plumb::ros_adapter

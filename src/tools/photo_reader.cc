// SPDX-FileCopyrightText: 2026 The Plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "tools/photo_reader.h"

#include <filesystem>
#include <stdexcept>
#include <system_error>

#include "plumbline/common/atomic_file.h"
#include "plumbline/image/content_hash.h"

namespace plumb::tools {
namespace {

namespace fs = std::filesystem;

// No photo is as large: a film that lies among the photos must not fill the memory.
constexpr std::uintmax_t kMaxPhotoBytes = std::uintmax_t{512} << 20;

// Throws std::runtime_error.
std::vector<std::uint8_t> ReadPhotoBytes(const std::string& path) {
  std::error_code error;
  if (fs::is_symlink(path, error) && !fs::exists(path, error)) {
    throw std::runtime_error(path + ": is a link to " + fs::read_symlink(path, error).string() +
                             ", which is not there; mount it, or put the photo in its place");
  }
  const std::uintmax_t size = fs::file_size(path, error);
  if (!error && size > kMaxPhotoBytes) {
    throw std::runtime_error(path + ": is larger than 512 MB, no photo is");
  }
  return ReadFileBytes(path);
}

std::uint64_t HashOf(const std::vector<std::uint8_t>& bytes) {
  return ContentHash(bytes.data(), bytes.size());
}

// Of a photo that was cut off before its analysis; nothing if its file is gone.
std::optional<std::uint64_t> HashOfFile(const std::string& path) {
  try {
    return HashOf(ReadPhotoBytes(path));
  } catch (const std::runtime_error&) {
    return std::nullopt;
  }
}

std::string FileName(const std::string& path) { return fs::path(path).filename().string(); }

}  // namespace

KnownPhotos::KnownPhotos(SessionStore* store) {
  for (const StoredPhoto& photo : store->Photos()) {
    const std::optional<std::uint64_t> hash = photo.analysis
                                                  ? photo.analysis->content_hash
                                                  : HashOfFile(store->photos().PathOf(photo.name));
    if (hash) photos_.insert({{FileName(photo.source_name), *hash}, photo.id});
  }
}

std::optional<PhotoId> KnownPhotos::Find(const std::string& source_name,
                                         std::uint64_t content_hash) const {
  const auto known = photos_.find({FileName(source_name), content_hash});
  if (known == photos_.end()) return std::nullopt;
  return known->second;
}

PhotoReader::PhotoReader(const FeatureOptions& options,
                         int width_px,
                         int height_px,
                         PhotoFolder* photos,
                         const KnownPhotos* known)
    : options_(options),
      width_px_(width_px),
      height_px_(height_px),
      photos_(photos),
      known_(known),
      stage_(1, [](std::packaged_task<ReadPhoto()> task) { task(); }) {}

std::future<ReadPhoto> PhotoReader::Start(const PhotoTask& task) {
  std::packaged_task<ReadPhoto()> work([this, task] { return Read(task); });
  std::future<ReadPhoto> photo = work.get_future();
  stage_.Push(std::move(work));
  return photo;
}

ReadPhoto PhotoReader::Read(const PhotoTask& task) const {
  ReadPhoto photo;
  photo.task = task;
  std::vector<std::uint8_t> bytes;
  try {
    bytes = ReadPhotoBytes(task.path);
  } catch (const std::runtime_error& error) {
    photo.trouble = error.what();
    if (!task.stored_id) return photo;
  }
  const std::uint64_t hash = HashOf(bytes);
  if (!task.stored_id) photo.known_as = known_->Find(task.source_name, hash);
  if (photo.known_as) return photo;
  photo.name = task.stored_id ? FileName(task.path) : photos_->ClaimName(task.source_name, bytes);
  if (photo.trouble.empty()) {
    photo.analysis = AnalyzePhoto(options_, bytes, width_px_, height_px_);
  } else {
    photo.analysis.status = PhotoStatus::kUndecodable;
    photo.analysis.detail = photo.trouble;
    photo.analysis.content_hash = hash;
  }
  photo.bytes = std::make_shared<const std::vector<std::uint8_t>>(std::move(bytes));
  return photo;
}

}  // namespace plumb::tools

// SPDX-FileCopyrightText: 2026 The Plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "map/session_photos.h"

#include <array>
#include <cstring>
#include <stdexcept>
#include <utility>

namespace plumb {
namespace {

// Blobs are the memory of these types, which the file's format therefore fixes.
static_assert(sizeof(Feature) == 4 * sizeof(float), "keypoints blob: four float32 a feature");
static_assert(sizeof(Rgb) == 3, "colors blob: three bytes a feature");
static_assert(__BYTE_ORDER__ == __ORDER_LITTLE_ENDIAN__, "blobs are little-endian");

constexpr std::array<std::pair<PhotoStatus, const char*>, 5> kStatusNames = {
    {{PhotoStatus::kOk, "ok"},
     {PhotoStatus::kUndecodable, "undecodable"},
     {PhotoStatus::kWrongSize, "wrong_size"},
     {PhotoStatus::kTooBlurred, "too_blurred"},
     {PhotoStatus::kTooFewFeatures, "too_few_features"}}};

std::string NameOf(PhotoStatus status) {
  for (const auto& [value, name] : kStatusNames) {
    if (value == status) return name;
  }
  throw std::logic_error("a photo status without a name");
}

PhotoStatus StatusOf(const std::string& word, const std::string& path) {
  for (const auto& [value, name] : kStatusNames) {
    if (word == name) return value;
  }
  throw std::runtime_error(path + ": unknown photo status \"" + word +
                           "\"; the file is damaged, choose another session folder");
}

std::optional<Timestamp> OptionalTime(const sqlite::Statement& row, int column) {
  if (row.IsNull(column)) return std::nullopt;
  return Timestamp{row.Int(column)};
}

// Columns from 5 on of ReadPhotos.
PhotoAnalysis AnalysisOf(const sqlite::Statement& row, const std::string& path) {
  PhotoAnalysis analysis;
  analysis.status = StatusOf(row.Text(5), path);
  analysis.detail = row.Text(6);
  analysis.content_hash = static_cast<std::uint64_t>(row.Int(7));
  analysis.metadata.width_px = static_cast<int>(row.Int(8));
  analysis.metadata.height_px = static_cast<int>(row.Int(9));
  analysis.metadata.exif_orientation = static_cast<int>(row.Int(10));
  analysis.metadata.focal_length_mm = row.OptionalDouble(11);
  analysis.metadata.exposure_time = OptionalTime(row, 12);
  if (!row.IsNull(13) && !row.IsNull(14)) {
    analysis.metadata.position =
        GeodeticPosition{row.Double(13), row.Double(14), row.OptionalDouble(15)};
  }
  analysis.blur_px = row.Double(16);
  analysis.decode_s = row.Double(17);
  analysis.features_s = row.Double(18);
  return analysis;
}

PhotoVerdict VerdictOf(const sqlite::Statement& row, const std::string& path) {
  PhotoVerdict verdict;
  verdict.photo = {static_cast<std::uint32_t>(row.Int(0))};
  verdict.name = row.Text(1);
  verdict.attempt = static_cast<int>(row.Int(2));
  try {
    verdict.status = VerdictStatusFromString(row.Text(3));
    verdict.reason = RefusalReasonFromString(row.Text(4));
  } catch (const std::invalid_argument& error) {
    throw std::runtime_error(path + ": " + error.what() +
                             "; the file is damaged, choose another session folder");
  }
  verdict.hint = row.Text(5);
  verdict.num_matches = static_cast<int>(row.Int(6));
  verdict.num_inliers = static_cast<int>(row.Int(7));
  verdict.median_error_px = row.Double(8);
  verdict.seconds = {row.Double(9),
                     row.Double(10),
                     row.Double(11),
                     row.Double(12),
                     row.Double(13),
                     row.Double(14),
                     row.Double(15),
                     row.Double(16)};
  return verdict;
}

// One blob into `size` bytes at `target`; a blob of another size means a damaged file.
void CopyBlob(sqlite::Database* database,
              const sqlite::Blob& blob,
              void* target,
              std::size_t size) {
  if (blob.size != size) database->Fail(SQLITE_CORRUPT);
  if (size > 0) std::memcpy(target, blob.data, size);
}

}  // namespace

void WriteAnalysis(sqlite::Database* database,
                   PhotoId id,
                   Timestamp exposure_time,
                   const PhotoAnalysis& analysis) {
  const PhotoMetadata& metadata = analysis.metadata;
  std::optional<std::int64_t> exif_time_ns;
  if (metadata.exposure_time) exif_time_ns = metadata.exposure_time->ns;
  std::optional<double> lat_deg;
  std::optional<double> lon_deg;
  std::optional<double> alt_m;
  if (metadata.position) {
    lat_deg = metadata.position->lat_deg;
    lon_deg = metadata.position->lon_deg;
    alt_m = metadata.position->alt_m;
  }
  database
      ->Prepared(
          "UPDATE photos SET exposure_time_ns = ?, status = ?, detail = ?, content_hash = ?, "
          "width_px = ?, height_px = ?, exif_orientation = ?, focal_length_mm = ?, "
          "exif_time_ns = ?, lat_deg = ?, lon_deg = ?, alt_m = ?, blur_px = ?, decode_s = ?, "
          "features_s = ? WHERE id = ?")
      .Run(exposure_time.ns,
           NameOf(analysis.status),
           analysis.detail,
           analysis.content_hash,
           metadata.width_px,
           metadata.height_px,
           metadata.exif_orientation,
           metadata.focal_length_mm,
           exif_time_ns,
           lat_deg,
           lon_deg,
           alt_m,
           analysis.blur_px,
           analysis.decode_s,
           analysis.features_s,
           id.value);
}

void WriteFeatures(sqlite::Database* database, PhotoId id, const FeatureSet& features) {
  database->Prepared("INSERT OR REPLACE INTO features VALUES (?, ?, ?, ?, ?)")
      .Run(id.value,
           std::uint64_t{features.size()},
           sqlite::Blob{features.features.data(), sizeof(Feature) * features.size()},
           sqlite::Blob{features.descriptors.data(),
                        static_cast<std::size_t>(features.descriptors.size())},
           sqlite::Blob{features.colors.data(), sizeof(Rgb) * features.colors.size()});
}

void WriteVerdict(sqlite::Database* database, const PhotoVerdict& verdict) {
  const StageSeconds& seconds = verdict.seconds;
  database
      ->Prepared(
          "INSERT INTO verdicts (photo, attempt, status, reason, hint, num_matches, num_inliers, "
          "median_error_px, decode_s, features_s, retrieval_s, matching_s, pose_s, verdict_s, "
          "expand_s, bundle_s) VALUES (?, ?, ?, ?, ?, ?, ?, ?, ?, ?, ?, ?, ?, ?, ?, ?)")
      .Run(verdict.photo.value,
           verdict.attempt,
           ToString(verdict.status),
           ToString(verdict.reason),
           verdict.hint,
           verdict.num_matches,
           verdict.num_inliers,
           verdict.median_error_px,
           seconds.decode_s,
           seconds.features_s,
           seconds.retrieval_s,
           seconds.matching_s,
           seconds.pose_s,
           seconds.verdict_s,
           seconds.expand_s,
           seconds.bundle_s);
}

void WriteSeconds(sqlite::Database* database, PhotoId id, const StageSeconds& seconds) {
  database
      ->Prepared(
          "UPDATE verdicts SET decode_s = ?, features_s = ?, retrieval_s = ?, matching_s = ?, "
          "pose_s = ?, verdict_s = ?, expand_s = ?, bundle_s = ? "
          "WHERE id = (SELECT max(id) FROM verdicts WHERE photo = ?)")
      .Run(seconds.decode_s,
           seconds.features_s,
           seconds.retrieval_s,
           seconds.matching_s,
           seconds.pose_s,
           seconds.verdict_s,
           seconds.expand_s,
           seconds.bundle_s,
           id.value);
}

std::vector<StoredPhoto> ReadPhotos(sqlite::Database* database) {
  sqlite::Statement row(
      database,
      "SELECT id, name, source_name, num_bytes, exposure_time_ns, status, detail, content_hash, "
      "width_px, height_px, exif_orientation, focal_length_mm, exif_time_ns, lat_deg, lon_deg, "
      "alt_m, blur_px, decode_s, features_s FROM photos ORDER BY id");
  std::vector<StoredPhoto> photos;
  while (row.Step()) {
    StoredPhoto photo;
    photo.id = {static_cast<std::uint32_t>(row.Int(0))};
    photo.name = row.Text(1);
    photo.source_name = row.Text(2);
    photo.num_bytes = static_cast<std::uint64_t>(row.Int(3));
    photo.exposure_time = OptionalTime(row, 4);
    if (photo.exposure_time) photo.analysis = AnalysisOf(row, database->path());
    photos.push_back(std::move(photo));
  }
  return photos;
}

FeatureSet ReadFeatures(sqlite::Database* database, PhotoId id) {
  sqlite::Statement& row = database->Prepared(
      "SELECT num_features, keypoints, descriptors, colors FROM features WHERE photo = ?");
  row.Start(id.value);
  FeatureSet features;
  if (!row.Step()) return features;
  const std::size_t count = static_cast<std::size_t>(row.Int(0));
  features.features.resize(count);
  features.descriptors.resize(static_cast<Eigen::Index>(count), kDescriptorSize);
  features.colors.resize(count);
  CopyBlob(database, row.Bytes(1), features.features.data(), sizeof(Feature) * count);
  CopyBlob(database, row.Bytes(2), features.descriptors.data(), kDescriptorSize * count);
  CopyBlob(database, row.Bytes(3), features.colors.data(), sizeof(Rgb) * count);
  while (row.Step()) {
  }
  return features;
}

std::vector<PhotoVerdict> ReadVerdicts(sqlite::Database* database,
                                       const std::string& table,
                                       const std::string& order) {
  sqlite::Statement row(database,
                        "SELECT v.photo, p.name, v.attempt, v.status, v.reason, v.hint, "
                        "v.num_matches, v.num_inliers, v.median_error_px, v.decode_s, "
                        "v.features_s, v.retrieval_s, v.matching_s, v.pose_s, v.verdict_s, "
                        "v.expand_s, v.bundle_s FROM " +
                            table + " v JOIN photos p ON p.id = v.photo ORDER BY v." + order);
  std::vector<PhotoVerdict> verdicts;
  while (row.Step()) verdicts.push_back(VerdictOf(row, database->path()));
  return verdicts;
}

}  // namespace plumb

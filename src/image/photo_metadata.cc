// SPDX-FileCopyrightText: 2026 The Plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "plumbline/image/photo_metadata.h"

#include <cmath>
#include <ctime>
#include <exiv2/exiv2.hpp>
#include <mutex>
#include <string>

namespace plumb {
namespace {

// The tag's value, if it is there, holds at least `count` components and is not empty.
const Exiv2::Exifdatum* Find(const Exiv2::ExifData& exif, const char* key, long count) {
  const auto found = exif.findKey(Exiv2::ExifKey(key));
  return found == exif.end() || found->count() < count ? nullptr : &*found;
}

std::optional<double> ReadNumber(const Exiv2::ExifData& exif, const char* key, long idx = 0) {
  const Exiv2::Exifdatum* datum = Find(exif, key, idx + 1);
  if (datum == nullptr) return std::nullopt;
  const Exiv2::Rational ratio = datum->toRational(idx);
  if (ratio.second == 0) return std::nullopt;
  return static_cast<double>(ratio.first) / static_cast<double>(ratio.second);
}

std::string ReadText(const Exiv2::ExifData& exif, const char* key) {
  const Exiv2::Exifdatum* datum = Find(exif, key, 1);
  return datum == nullptr ? "" : datum->toString();
}

// Digits of EXIF's SubSecTimeOriginal: a decimal fraction of a second.
std::int64_t ParseSubSeconds(const std::string& digits) {
  std::int64_t ns = 0;
  std::int64_t unit_ns = 100'000'000;
  for (const char digit : digits) {
    if (digit < '0' || digit > '9') break;
    ns += (digit - '0') * unit_ns;
    unit_ns /= 10;
  }
  return ns;
}

std::optional<Timestamp> ReadExposureTime(const Exiv2::ExifData& exif) {
  std::tm time{};
  int end = 0;
  const std::string text = ReadText(exif, "Exif.Photo.DateTimeOriginal");
  const int num_read = std::sscanf(text.c_str(),
                                   "%4d:%2d:%2d %2d:%2d:%2d%n",
                                   &time.tm_year,
                                   &time.tm_mon,
                                   &time.tm_mday,
                                   &time.tm_hour,
                                   &time.tm_min,
                                   &time.tm_sec,
                                   &end);
  const std::tm read = time;
  if (num_read != 6 || read.tm_year < 1970 || read.tm_mon < 1) return std::nullopt;
  time.tm_year -= 1900;
  time.tm_mon -= 1;
  const std::time_t seconds = timegm(&time);
  // timegm carries what is out of range into the next field.
  if (time.tm_mday != read.tm_mday || time.tm_hour != read.tm_hour || time.tm_min != read.tm_min) {
    return std::nullopt;
  }
  const std::int64_t sub_ns = ParseSubSeconds(ReadText(exif, "Exif.Photo.SubSecTimeOriginal"));
  return Timestamp{std::int64_t{seconds} * 1'000'000'000 + sub_ns};
}

// Degrees, minutes and seconds with the hemisphere's letter.
std::optional<double> ReadAngle(const Exiv2::ExifData& exif,
                                const std::string& key,
                                char negative_letter,
                                double bound_deg) {
  const std::string reference = ReadText(exif, (key + "Ref").c_str());
  const std::optional<double> degrees = ReadNumber(exif, key.c_str(), 0);
  const std::optional<double> minutes = ReadNumber(exif, key.c_str(), 1);
  const std::optional<double> seconds = ReadNumber(exif, key.c_str(), 2);
  if (reference.empty() || !degrees || !minutes || !seconds) return std::nullopt;
  const double angle_deg = *degrees + *minutes / 60.0 + *seconds / 3600.0;
  if (angle_deg < 0.0 || angle_deg > bound_deg) return std::nullopt;
  return reference[0] == negative_letter ? -angle_deg : angle_deg;
}

std::optional<GeodeticPosition> ReadPosition(const Exiv2::ExifData& exif) {
  const std::optional<double> lat = ReadAngle(exif, "Exif.GPSInfo.GPSLatitude", 'S', 90.0);
  const std::optional<double> lon = ReadAngle(exif, "Exif.GPSInfo.GPSLongitude", 'W', 180.0);
  if (!lat || !lon) return std::nullopt;
  GeodeticPosition position{*lat, *lon, std::nullopt};
  const std::optional<double> alt_m = ReadNumber(exif, "Exif.GPSInfo.GPSAltitude");
  const bool is_below_sea = ReadNumber(exif, "Exif.GPSInfo.GPSAltitudeRef").value_or(0.0) == 1.0;
  if (alt_m) position.alt_m = is_below_sea ? -*alt_m : *alt_m;
  return position;
}

void ReadExif(const Exiv2::ExifData& exif, PhotoMetadata* metadata) {
  const double orientation = ReadNumber(exif, "Exif.Image.Orientation").value_or(1.0);
  if (orientation >= 1.0 && orientation <= 8.0) {
    metadata->exif_orientation = static_cast<int>(orientation);
  }
  metadata->focal_length_mm = ReadNumber(exif, "Exif.Photo.FocalLength");
  if (metadata->focal_length_mm.value_or(1.0) <= 0.0) metadata->focal_length_mm.reset();
  metadata->exposure_time = ReadExposureTime(exif);
  metadata->position = ReadPosition(exif);
}

}  // namespace

PhotoMetadata ReadPhotoMetadata(const std::vector<std::uint8_t>& bytes) {
  // Exiv2's XMP toolkit and log are global; reading takes well under a millisecond.
  static std::mutex mutex;
  const std::lock_guard<std::mutex> lock(mutex);
  PhotoMetadata metadata;
  Exiv2::LogMsg::setLevel(Exiv2::LogMsg::mute);
  try {
    const auto image = Exiv2::ImageFactory::open(bytes.data(), static_cast<long>(bytes.size()));
    image->readMetadata();
    metadata.width_px = image->pixelWidth();
    metadata.height_px = image->pixelHeight();
    ReadExif(image->exifData(), &metadata);
  } catch (const std::exception&) {
    // Damaged metadata say nothing of the picture; what was read before stands.
  }
  return metadata;
}

}  // namespace plumb

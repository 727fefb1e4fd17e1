// SPDX-FileCopyrightText: 2026 The Plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include <cmath>
#include <ctime>
#include <exiv2/exiv2.hpp>
#include <mutex>
#include <opencv2/imgcodecs.hpp>
#include <string>

#include "plumbline/common/check.h"
#include "plumbline/common/options.h"
#include "plumbline/simulation/sensor.h"

namespace plumb {
namespace {

constexpr std::int64_t kNsPerSecond = 1'000'000'000;

Exiv2::URational Ratio(double value, std::uint32_t denominator) {
  return {static_cast<std::uint32_t>(std::llround(value * denominator)), denominator};
}

// As cameras write it: 1/800 s, but 2.5 s.
Exiv2::URational ExposureTime(double time_s) {
  if (time_s >= 0.5) return Ratio(time_s, 10);
  return {1, static_cast<std::uint32_t>(std::lround(1.0 / time_s))};
}

// Degrees, minutes and seconds; 1e-6 seconds of arc are 0.03 mm on the ground.
Exiv2::URationalValue ToAngle(double angle_deg) {
  const auto micro_seconds = std::llround(std::abs(angle_deg) * 3600e6);
  Exiv2::URationalValue value;
  value.value_.emplace_back(static_cast<std::uint32_t>(micro_seconds / 3'600'000'000), 1U);
  value.value_.emplace_back(static_cast<std::uint32_t>(micro_seconds / 60'000'000 % 60), 1U);
  value.value_.emplace_back(static_cast<std::uint32_t>(micro_seconds % 60'000'000), 1'000'000U);
  return value;
}

void AddTime(Timestamp time, Exiv2::ExifData* exif) {
  const std::time_t seconds = time.ns / kNsPerSecond;
  std::tm utc{};
  gmtime_r(&seconds, &utc);
  std::string text(sizeof("2026:01:02 03:04:05"), '\0');
  text.resize(std::strftime(text.data(), text.size(), "%Y:%m:%d %H:%M:%S", &utc));
  std::string sub_seconds = std::to_string(kNsPerSecond + time.ns % kNsPerSecond).substr(1);
  (*exif)["Exif.Image.DateTime"] = text;
  (*exif)["Exif.Photo.DateTimeOriginal"] = text;
  (*exif)["Exif.Photo.DateTimeDigitized"] = text;
  (*exif)["Exif.Photo.SubSecTimeOriginal"] = sub_seconds;
}

void AddPosition(const GeodeticPosition& position, Exiv2::ExifData* exif) {
  const Exiv2::URationalValue lat = ToAngle(position.lat_deg);
  const Exiv2::URationalValue lon = ToAngle(position.lon_deg);
  exif->add(Exiv2::ExifKey("Exif.GPSInfo.GPSLatitude"), &lat);
  (*exif)["Exif.GPSInfo.GPSLatitudeRef"] = position.lat_deg < 0.0 ? "S" : "N";
  exif->add(Exiv2::ExifKey("Exif.GPSInfo.GPSLongitude"), &lon);
  (*exif)["Exif.GPSInfo.GPSLongitudeRef"] = position.lon_deg < 0.0 ? "W" : "E";
  if (!position.alt_m) return;
  (*exif)["Exif.GPSInfo.GPSAltitude"] = Ratio(std::abs(*position.alt_m), 1000);
  const Exiv2::byte is_below_sea = *position.alt_m < 0.0 ? 1 : 0;
  Exiv2::DataValue reference(&is_below_sea, 1, Exiv2::invalidByteOrder, Exiv2::unsignedByte);
  exif->add(Exiv2::ExifKey("Exif.GPSInfo.GPSAltitudeRef"), &reference);
}

Exiv2::ExifData MakeExif(const SensorOptions& options,
                         const Exposure& exposure,
                         const PhotoTags& tags) {
  Exiv2::ExifData exif;
  exif["Exif.Image.Make"] = options.make;
  exif["Exif.Image.Model"] = options.model;
  exif["Exif.Image.Orientation"] = std::uint16_t{1};
  exif["Exif.Photo.ExposureTime"] = ExposureTime(exposure.time_s);
  exif["Exif.Photo.FNumber"] = Ratio(options.f_number, 10);
  exif["Exif.Photo.ISOSpeedRatings"] = static_cast<std::uint16_t>(exposure.iso);
  exif["Exif.Photo.FocalLength"] = Ratio(tags.focal_length_mm, 1000);
  exif["Exif.Photo.FocalLengthIn35mmFilm"] =
      static_cast<std::uint16_t>(std::lround(tags.focal_length_35mm));
  AddTime(tags.exposure_time, &exif);
  if (tags.position) AddPosition(*tags.position, &exif);
  return exif;
}

std::vector<std::uint8_t> WithExif(const std::vector<std::uint8_t>& jpeg,
                                   const Exiv2::ExifData& exif) {
  const auto image = Exiv2::ImageFactory::open(jpeg.data(), static_cast<long>(jpeg.size()));
  image->setExifData(exif);
  image->writeMetadata();
  Exiv2::BasicIo& io = image->io();
  io.open();
  const Exiv2::DataBuf file = io.read(static_cast<long>(io.size()));
  return {file.pData_, file.pData_ + file.size_};
}

}  // namespace

std::vector<std::uint8_t> EncodePhoto(const SensorOptions& options,
                                      const cv::Mat& picture,
                                      const Exposure& exposure,
                                      const PhotoTags& tags) {
  ThrowIfProblems("sensor", options.Problems());
  PLUMB_CHECK(picture.type() == CV_8UC3 && !picture.empty());
  std::vector<std::uint8_t> jpeg;
  cv::imencode(".jpg", picture, jpeg, {cv::IMWRITE_JPEG_QUALITY, options.jpeg_quality});
  if (!options.exif) return jpeg;
  static std::mutex mutex;  // Exiv2's XMP toolkit and log are global.
  const std::lock_guard<std::mutex> lock(mutex);
  return WithExif(jpeg, MakeExif(options, exposure, tags));
}

}  // namespace plumb

// SPDX-FileCopyrightText: 2026 The Plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "plumbline/image/photo_analysis.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <array>
#include <cstdlib>
#include <exiv2/exiv2.hpp>
#include <filesystem>
#include <fstream>
#include <iterator>

#include "test/image/synthetic_photo.h"

namespace plumb {
namespace {

using ::testing::AllOf;
using testing::Encode;
using ::testing::HasSubstr;
using testing::RenderTexture;
using Bytes = std::vector<std::uint8_t>;

constexpr int kWidth = 640;
constexpr int kHeight = 480;

const cv::Mat& Texture() {
  static const cv::Mat texture = RenderTexture(kWidth, kHeight, /*seed=*/1);
  return texture;
}

PhotoAnalysis Analyze(const Bytes& bytes) { return AnalyzePhoto({}, bytes, kWidth, kHeight); }

Bytes WithExif(const Bytes& bytes, const Exiv2::ExifData& exif) {
  const auto image = Exiv2::ImageFactory::open(bytes.data(), static_cast<long>(bytes.size()));
  image->setExifData(exif);
  image->writeMetadata();
  Exiv2::BasicIo& io = image->io();
  io.open();
  Bytes result(io.size());
  io.read(result.data(), static_cast<long>(result.size()));
  return result;
}

Exiv2::ExifData FlightExif() {
  Exiv2::ExifData exif;
  exif["Exif.Image.Orientation"] = std::uint16_t{6};
  exif["Exif.Photo.FocalLength"] = Exiv2::Rational(165, 10);
  exif["Exif.Photo.DateTimeOriginal"] = "2026:05:04 13:14:15";
  exif["Exif.Photo.SubSecTimeOriginal"] = "25";
  exif["Exif.GPSInfo.GPSLatitudeRef"] = "S";
  exif["Exif.GPSInfo.GPSLatitude"] = "47/1 30/1 1800/100";
  exif["Exif.GPSInfo.GPSLongitudeRef"] = "E";
  exif["Exif.GPSInfo.GPSLongitude"] = "15/1 15/1 0/1";
  exif["Exif.GPSInfo.GPSAltitude"] = Exiv2::Rational(3505, 10);
  return exif;
}

TEST(AnalyzePhoto, AcceptsAnOrdinaryPhoto) {
  const PhotoAnalysis analysis = Analyze(Encode(Texture(), ".jpg"));
  EXPECT_EQ(analysis.status, PhotoStatus::kOk);
  EXPECT_EQ(analysis.detail, "");
  EXPECT_EQ(analysis.metadata.width_px, kWidth);
  EXPECT_EQ(analysis.metadata.height_px, kHeight);
  EXPECT_FALSE(analysis.metadata.focal_length_mm);
  EXPECT_FALSE(analysis.metadata.exposure_time);
  EXPECT_FALSE(analysis.metadata.position);
  EXPECT_GT(analysis.features.size(), 500U);
}

TEST(AnalyzePhoto, RefusesAnEmptyFile) {
  const PhotoAnalysis analysis = Analyze({});
  EXPECT_EQ(analysis.status, PhotoStatus::kUndecodable);
  EXPECT_THAT(analysis.detail, HasSubstr("empty"));
}

TEST(AnalyzePhoto, RefusesWhatIsNoPicture) {
  const std::string text = "photo,qw,qx,qy,qz\n0000.jpg,1,0,0,0\n";
  const PhotoAnalysis analysis = Analyze(Bytes(text.begin(), text.end()));
  EXPECT_EQ(analysis.status, PhotoStatus::kUndecodable);
  EXPECT_THAT(analysis.detail, HasSubstr("no photo"));
  EXPECT_NE(analysis.content_hash, 0U);
}

TEST(AnalyzePhoto, RefusesAJpegThatIsCutOffAnywhere) {
  const Bytes whole = Encode(Texture(), ".jpg");
  for (int percent = 1; percent < 100; percent += 7) {
    const Bytes part(whole.begin(),
                     whole.begin() + static_cast<std::ptrdiff_t>(whole.size()) * percent / 100);
    EXPECT_EQ(Analyze(part).status, PhotoStatus::kUndecodable) << percent << " %";
  }
  const Bytes half(whole.begin(), whole.begin() + static_cast<std::ptrdiff_t>(whole.size() / 2));
  EXPECT_THAT(Analyze(half).detail, HasSubstr("ends in the middle"));
}

// What it prints to standard error is in the way of what the caller says.
PhotoAnalysis AnalyzeSilently(const Bytes& bytes) {
  ::testing::internal::CaptureStderr();
  const PhotoAnalysis analysis = Analyze(bytes);
  EXPECT_EQ(::testing::internal::GetCapturedStderr(), "");
  return analysis;
}

TEST(AnalyzePhoto, RefusesOtherKindsThatAreCutOffAnywhere) {
  for (const char* extension : {".png", ".bmp", ".tif"}) {
    const Bytes whole = Encode(Texture(), extension);
    EXPECT_EQ(AnalyzeSilently(whole).status, PhotoStatus::kOk) << extension;
    for (int percent = 1; percent < 100; percent += 7) {
      const Bytes part(whole.begin(),
                       whole.begin() + static_cast<std::ptrdiff_t>(whole.size()) * percent / 100);
      const PhotoAnalysis analysis = AnalyzeSilently(part);
      EXPECT_EQ(analysis.status, PhotoStatus::kUndecodable) << extension << percent << " %";
      EXPECT_THAT(analysis.detail, HasSubstr("ends in the middle")) << extension << percent << " %";
    }
  }
}

TEST(AnalyzePhoto, RefusesADamagedPng) {
  Bytes bytes = Encode(Texture(), ".png");
  bytes[bytes.size() / 2] ^= 0x10;
  const PhotoAnalysis analysis = AnalyzeSilently(bytes);
  EXPECT_EQ(analysis.status, PhotoStatus::kUndecodable);
  EXPECT_THAT(analysis.detail, HasSubstr("the PNG data are damaged"));
}

// Its directory before its strips, as cameras write it and OpenCV does not.
Bytes TiffWithDirectoryFirst(const cv::Mat& image) {
  const auto size = static_cast<std::uint32_t>(image.total() * image.elemSize());
  const std::vector<std::array<std::uint32_t, 3>> fields = {{256, 4, kWidth},
                                                            {257, 4, kHeight},
                                                            {258, 3, 8},
                                                            {259, 3, 1},
                                                            {262, 3, 1},
                                                            {273, 4, 146},
                                                            {277, 3, 1},
                                                            {278, 4, kHeight},
                                                            {279, 4, size}};
  Bytes bytes = {'I', 'I', 42, 0, 8, 0, 0, 0, static_cast<std::uint8_t>(fields.size()), 0};
  const auto append = [&bytes](std::uint32_t value, int num_bytes) {
    for (int i = 0; i < num_bytes; ++i) bytes.push_back(static_cast<std::uint8_t>(value >> 8 * i));
  };
  for (const auto& [tag, type, value] : fields) {
    append(tag, 2);
    append(type, 2);
    append(1, 4);
    append(value, 4);
  }
  bytes.resize(146);
  bytes.insert(bytes.end(), image.datastart, image.dataend);
  return bytes;
}

TEST(AnalyzePhoto, RefusesATiffWhoseStripsAreCutOff) {
  cv::Mat gray;
  cv::cvtColor(Texture(), gray, cv::COLOR_BGR2GRAY);
  Bytes bytes = TiffWithDirectoryFirst(gray);
  EXPECT_EQ(AnalyzeSilently(bytes).status, PhotoStatus::kOk);
  bytes.resize(bytes.size() - 1);
  EXPECT_THAT(AnalyzeSilently(bytes).detail, HasSubstr("ends in the middle"));
}

TEST(AnalyzePhoto, AcceptsStrayBytesBeforeTheEndOfAJpeg) {
  Bytes bytes = Encode(Texture(), ".jpg");
  bytes.insert(bytes.end() - 2, {0x01, 0x02, 0x03});
  EXPECT_EQ(Analyze(bytes).status, PhotoStatus::kOk);
}

TEST(AnalyzePhoto, SurvivesRandomDamage) {
  std::mt19937 rng(11);
  const cv::Mat small = Texture()(cv::Rect(0, 0, 160, 120)).clone();
  for (const char* extension : {".jpg", ".png", ".tiff", ".bmp"}) {
    const Bytes whole = WithExif(Encode(Texture(), ".jpg"), FlightExif());
    const Bytes original = std::string(extension) == ".jpg"
                               ? WithExif(Encode(small, ".jpg"), FlightExif())
                               : Encode(small, extension);
    for (int round = 0; round < 60; ++round) {
      Bytes bytes = original;
      for (int i = 0; i < 8; ++i) {
        // Half of the damage goes to the headers.
        const std::size_t range =
            i % 2 == 0 ? bytes.size() : std::min<std::size_t>(400, bytes.size());
        bytes[rng() % range] = static_cast<std::uint8_t>(rng());
      }
      EXPECT_NO_THROW(AnalyzePhoto({}, bytes, 160, 120)) << extension << ' ' << round;
    }
  }
}

TEST(AnalyzePhoto, RefusesOnePixelAsTheWrongSize) {
  const cv::Mat pixel(1, 1, CV_8UC3, cv::Scalar(1, 2, 3));
  for (const char* extension : {".jpg", ".png"}) {
    const PhotoAnalysis analysis = Analyze(Encode(pixel, extension));
    EXPECT_EQ(analysis.status, PhotoStatus::kWrongSize);
    EXPECT_THAT(analysis.detail, AllOf(HasSubstr("1 x 1"), HasSubstr("640 x 480")));
  }
}

TEST(AnalyzePhoto, RefusesOnePixelOfACameraOfOnePixelAsFeatureless) {
  const cv::Mat pixel(1, 1, CV_8UC3, cv::Scalar(1, 2, 3));
  for (const char* extension : {".jpg", ".png"}) {
    EXPECT_EQ(AnalyzePhoto({}, Encode(pixel, extension), 1, 1).status,
              PhotoStatus::kTooFewFeatures);
  }
}

TEST(AnalyzePhoto, RefusesAnotherCamerasSize) {
  const PhotoAnalysis analysis = AnalyzePhoto({}, Encode(Texture(), ".jpg"), 4000, 3000);
  EXPECT_EQ(analysis.status, PhotoStatus::kWrongSize);
  EXPECT_THAT(analysis.detail,
              AllOf(HasSubstr("640 x 480"), HasSubstr("4000 x 3000"), Not(HasSubstr("rotated"))));
}

TEST(AnalyzePhoto, SaysThatAPhotoWasRotatedByAProgram) {
  cv::Mat turned;
  cv::rotate(Texture(), turned, cv::ROTATE_90_CLOCKWISE);
  const PhotoAnalysis analysis = Analyze(Encode(turned, ".jpg"));
  EXPECT_EQ(analysis.status, PhotoStatus::kWrongSize);
  EXPECT_THAT(analysis.detail, AllOf(HasSubstr("rotated"), HasSubstr("480 x 640")));
}

// A header that promises 65 000 x 65 000 pixels, in a file of some kilobytes.
TEST(AnalyzePhoto, RefusesADecompressionBomb) {
  Bytes png = Encode(Texture(), ".png");
  for (const std::size_t at : {16U, 20U}) {  // Big-endian width and height of IHDR.
    png[at + 2] = 0xFD;
    png[at + 3] = 0xE8;
  }
  Bytes jpeg = Encode(Texture(), ".jpg");
  for (std::size_t i = 2; i + 9 < jpeg.size(); ++i) {
    if (jpeg[i] != 0xFF || jpeg[i + 1] != 0xC0) continue;
    jpeg[i + 5] = jpeg[i + 7] = 0xFD;
    jpeg[i + 6] = jpeg[i + 8] = 0xE8;
    break;
  }
  for (const Bytes& bytes : {png, jpeg}) {
    const PhotoAnalysis analysis = AnalyzePhoto({}, bytes, 65000, 65000);
    EXPECT_EQ(analysis.status, PhotoStatus::kUndecodable);
    EXPECT_THAT(analysis.detail, HasSubstr("65000 x 65000"));
  }
}

TEST(AnalyzePhoto, ReadsGrayAndSixteenBitAndAlphaAlike) {
  cv::Mat gray;
  cv::cvtColor(Texture(), gray, cv::COLOR_BGR2GRAY);
  cv::Mat gray16;
  gray.convertTo(gray16, CV_16U, 257.0);
  cv::Mat color16;
  Texture().convertTo(color16, CV_16U, 257.0);
  cv::Mat with_alpha;
  cv::cvtColor(Texture(), with_alpha, cv::COLOR_BGR2BGRA);
  const std::size_t num_expected = Analyze(Encode(Texture(), ".png")).features.size();
  ASSERT_GT(num_expected, 500U);
  for (const Bytes& bytes : {Encode(gray, ".png"),
                             Encode(gray, ".jpg"),
                             Encode(gray16, ".png"),
                             Encode(gray16, ".tiff"),
                             Encode(color16, ".png"),
                             Encode(color16, ".tiff"),
                             Encode(with_alpha, ".png"),
                             Encode(Texture(), ".tiff"),
                             Encode(Texture(), ".bmp")}) {
    const PhotoAnalysis analysis = Analyze(bytes);
    EXPECT_EQ(analysis.status, PhotoStatus::kOk) << analysis.detail;
    EXPECT_NEAR(static_cast<double>(analysis.features.size()),
                static_cast<double>(num_expected),
                0.05 * static_cast<double>(num_expected));
  }
}

TEST(AnalyzePhoto, ReadsAProgressiveJpeg) {
  Bytes bytes;
  cv::imencode(".jpg", Texture(), bytes, {cv::IMWRITE_JPEG_PROGRESSIVE, 1});
  const PhotoAnalysis progressive = Analyze(bytes);
  EXPECT_EQ(progressive.status, PhotoStatus::kOk) << progressive.detail;
  EXPECT_EQ(progressive.features.descriptors,
            Analyze(Encode(Texture(), ".jpg")).features.descriptors);
}

TEST(AnalyzePhoto, ReadsExifButDoesNotApplyItsRotation) {
  const Bytes plain = Encode(Texture(), ".jpg");
  const PhotoAnalysis analysis = Analyze(WithExif(plain, FlightExif()));
  ASSERT_EQ(analysis.status, PhotoStatus::kOk) << analysis.detail;
  EXPECT_EQ(analysis.metadata.exif_orientation, 6);
  EXPECT_EQ(analysis.metadata.width_px, kWidth);
  EXPECT_EQ(analysis.features.descriptors, Analyze(plain).features.descriptors);
  EXPECT_DOUBLE_EQ(analysis.metadata.focal_length_mm.value_or(0.0), 16.5);
  EXPECT_EQ(analysis.metadata.exposure_time.value_or(Timestamp{}).ns, 1777900455'250'000'000);
  ASSERT_TRUE(analysis.metadata.position);
  EXPECT_NEAR(analysis.metadata.position->lat_deg, -47.505, 1e-9);
  EXPECT_NEAR(analysis.metadata.position->lon_deg, 15.25, 1e-9);
  EXPECT_DOUBLE_EQ(analysis.metadata.position->alt_m.value_or(0.0), 350.5);
}

TEST(AnalyzePhoto, ReadsPngPhotosWithARotationFlagUnrotated) {
  const PhotoAnalysis analysis = Analyze(WithExif(Encode(Texture(), ".png"), FlightExif()));
  EXPECT_EQ(analysis.status, PhotoStatus::kOk) << analysis.detail;
  EXPECT_EQ(analysis.metadata.exif_orientation, 6);
}

TEST(AnalyzePhoto, LeavesOutExifThatMakesNoSense) {
  Exiv2::ExifData exif;
  exif["Exif.Image.Orientation"] = std::uint16_t{99};
  exif["Exif.Photo.FocalLength"] = Exiv2::Rational(0, 0);
  exif["Exif.Photo.DateTimeOriginal"] = "0000:00:00 00:00:00";
  exif["Exif.GPSInfo.GPSLatitudeRef"] = "N";
  exif["Exif.GPSInfo.GPSLatitude"] = "470/1 0/0 0/1";
  exif["Exif.GPSInfo.GPSLongitudeRef"] = "E";
  exif["Exif.GPSInfo.GPSLongitude"] = "15/1";
  const PhotoAnalysis analysis = Analyze(WithExif(Encode(Texture(), ".jpg"), exif));
  EXPECT_EQ(analysis.status, PhotoStatus::kOk) << analysis.detail;
  EXPECT_EQ(analysis.metadata.exif_orientation, 1);
  EXPECT_FALSE(analysis.metadata.focal_length_mm);
  EXPECT_FALSE(analysis.metadata.exposure_time);
  EXPECT_FALSE(analysis.metadata.position);
}

TEST(AnalyzePhoto, AcceptsAPhotoWhoseExifIsGarbage) {
  Bytes bytes = WithExif(Encode(Texture(), ".jpg"), FlightExif());
  const std::string mark = "Exif";
  const auto begin = std::search(bytes.begin(), bytes.end(), mark.begin(), mark.end());
  ASSERT_NE(begin, bytes.end());
  std::mt19937 rng(3);
  std::generate(begin + 6, begin + 200, [&] { return static_cast<std::uint8_t>(rng()); });
  const PhotoAnalysis analysis = Analyze(bytes);
  EXPECT_EQ(analysis.status, PhotoStatus::kOk) << analysis.detail;
  EXPECT_FALSE(analysis.metadata.position);
}

TEST(AnalyzePhoto, RefusesABlackPhotoAndABlankWall) {
  cv::Mat wall(kHeight, kWidth, CV_8UC3, cv::Scalar(190, 200, 200));
  cv::Mat noise(wall.size(), CV_8SC3);
  cv::RNG(1).fill(noise, cv::RNG::NORMAL, 0.0, 1.5);
  cv::add(wall, noise, wall, cv::noArray(), CV_8UC3);
  for (const cv::Mat& image : {cv::Mat(kHeight, kWidth, CV_8UC3, cv::Scalar(0, 0, 0)), wall}) {
    const PhotoAnalysis analysis = Analyze(Encode(image, ".jpg"));
    EXPECT_EQ(analysis.status, PhotoStatus::kTooFewFeatures);
    EXPECT_EQ(analysis.features.size(), 0U);
    EXPECT_THAT(analysis.detail, HasSubstr("features"));
  }
}

// Steps of all directions at random, like the edges of stones.
cv::Mat Stones(int width_px, int height_px) {
  cv::Mat image(height_px, width_px, CV_8UC3, cv::Scalar(120, 120, 120));
  std::mt19937 rng(9);
  for (int i = 0; i < 900; ++i) {
    const cv::RotatedRect stone(
        cv::Point2f(static_cast<float>(rng() % static_cast<unsigned int>(width_px)),
                    static_cast<float>(rng() % static_cast<unsigned int>(height_px))),
        cv::Size2f(static_cast<float>(60 + rng() % 160), static_cast<float>(60 + rng() % 160)),
        static_cast<float>(rng() % 180));
    cv::Point2f corners[4];
    stone.points(corners);
    const std::vector<cv::Point> polygon(corners, corners + 4);
    cv::fillConvexPoly(
        image, polygon, cv::Scalar::all(static_cast<double>(rng() % 256)), cv::LINE_AA);
  }
  return image;
}

TEST(Blur, IsEstimatedInPixelsOfTheFullResolution) {
  const int width_px = 3072;
  const int height_px = 2048;
  const cv::Mat sharp = Stones(width_px, height_px);
  for (const double sigma_px : {3.0, 4.5, 8.0}) {
    cv::Mat blurred;
    cv::GaussianBlur(sharp, blurred, {}, sigma_px);
    const PhotoAnalysis analysis = AnalyzePhoto({}, Encode(blurred, ".jpg"), width_px, height_px);
    EXPECT_NEAR(analysis.blur_px, sigma_px, 0.15 * sigma_px + 0.3);
  }
}

TEST(Blur, OfDefocusOrMotionIsRefused) {
  const int width_px = 3072;
  const int height_px = 2048;
  const cv::Mat sharp = Stones(width_px, height_px);
  EXPECT_NE(AnalyzePhoto({}, Encode(sharp, ".jpg"), width_px, height_px).status,
            PhotoStatus::kTooBlurred);
  cv::Mat defocused;
  cv::GaussianBlur(sharp, defocused, {}, 8.0);
  cv::Mat moved;  // By 25 pixels along x; edges along x stay sharp.
  cv::blur(sharp, moved, {25, 1});
  for (const cv::Mat& image : {defocused, moved}) {
    const PhotoAnalysis analysis = AnalyzePhoto({}, Encode(image, ".jpg"), width_px, height_px);
    EXPECT_EQ(analysis.status, PhotoStatus::kTooBlurred);
    EXPECT_EQ(analysis.features.size(), 0U);
    EXPECT_THAT(analysis.detail, HasSubstr("blurred by about"));
  }
}

TEST(RealPhotos, AreAcceptedWithAWideMarginToTheBlurBound) {
  const char* given = std::getenv("PLUMBLINE_DATA");
  const std::filesystem::path data =
      given != nullptr ? given : PLUMBLINE_SOURCE_DIR "/../shared/data";
  const std::filesystem::path photos = data / "fountain-P11" / "photos";
  if (!std::filesystem::is_directory(photos)) {
    GTEST_SKIP() << "no real photos at " << photos << "; set PLUMBLINE_DATA";
  }
  for (const char* name : {"0000.jpg", "0005.jpg", "0010.jpg"}) {
    std::ifstream file(photos / name, std::ios::binary);
    const Bytes bytes((std::istreambuf_iterator<char>(file)), std::istreambuf_iterator<char>());
    const PhotoAnalysis analysis = AnalyzePhoto({}, bytes, 3072, 2048);
    EXPECT_EQ(analysis.status, PhotoStatus::kOk) << name << ": " << analysis.detail;
    EXPECT_EQ(analysis.features.size(), 5000U);
    EXPECT_LT(analysis.blur_px, 3.0);
  }
}

}  // namespace
}  // namespace plumb

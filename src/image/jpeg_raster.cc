// SPDX-FileCopyrightText: 2026 The Plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "image/jpeg_raster.h"

#include <jerror.h>
#include <jpeglib.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <csetjmp>
#include <cstdio>

#include "image/file_damage.h"
#include "image/parallel_for.h"
#include "image/scaled_idct.h"

namespace plumb {
namespace {

constexpr int kBlockRowsPerPart = 8;

// libjpeg's callbacks find the whole struct behind its first member.
struct JpegErrors {
  jpeg_error_mgr manager;
  std::jmp_buf on_fatal;
  bool is_cut_off = false;
  bool is_damaged = false;
};

JpegErrors& ErrorsOf(j_common_ptr info) { return *reinterpret_cast<JpegErrors*>(info->err); }

[[noreturn]] void OnFatal(j_common_ptr info) { std::longjmp(ErrorsOf(info).on_fatal, 1); }

void OnMessage(j_common_ptr info, int level) {
  if (level >= 0) return;  // A trace, no warning.
  switch (info->err->msg_code) {
    case JWRN_JPEG_EOF:
      ErrorsOf(info).is_cut_off = true;
      break;
    case JWRN_EXTRANEOUS_DATA:
    case JWRN_ADOBE_XFORM:
      break;
    default:
      ErrorsOf(info).is_damaged = true;
  }
}

void OnOutput(j_common_ptr /*info*/) {}

// A libjpeg decompressor on bytes in memory. No object with a destructor may live in a frame that
// libjpeg jumps out of; hence one member function for each call that can.
class JpegReader {
 public:
  explicit JpegReader(const std::vector<std::uint8_t>& bytes) : bytes_(bytes) {
    info_.err = jpeg_std_error(&errors_.manager);
    errors_.manager.error_exit = OnFatal;
    errors_.manager.emit_message = OnMessage;
    errors_.manager.output_message = OnOutput;
  }
  ~JpegReader() { jpeg_destroy_decompress(&info_); }
  JpegReader(const JpegReader&) = delete;
  JpegReader& operator=(const JpegReader&) = delete;

  bool ReadHeader() {
    if (setjmp(errors_.on_fatal) != 0) return false;
    jpeg_create_decompress(&info_);
    jpeg_mem_src(&info_, bytes_.data(), bytes_.size());
    return jpeg_read_header(&info_, TRUE) == JPEG_HEADER_OK;
  }

  bool ReadCoefficients() {
    if (setjmp(errors_.on_fatal) != 0) return false;
    arrays_ = jpeg_read_coefficients(&info_);
    return arrays_ != nullptr;
  }

  // The blocks of one block row of a component; they stay where they are until destruction,
  // for libjpeg has been given no bound on memory and keeps all of them there.
  const JBLOCK* BlockRow(int component, int row) {
    if (setjmp(errors_.on_fatal) != 0) return nullptr;
    return info_.mem->access_virt_barray(reinterpret_cast<j_common_ptr>(&info_),
                                         arrays_[component],
                                         static_cast<JDIMENSION>(row),
                                         1,
                                         FALSE)[0];
  }

  const jpeg_decompress_struct& info() const { return info_; }
  const JpegErrors& errors() const { return errors_; }

 private:
  const std::vector<std::uint8_t>& bytes_;
  jpeg_decompress_struct info_{};
  JpegErrors errors_{};
  jvirt_barray_ptr* arrays_ = nullptr;
};

// One component's coefficients.
struct Plane {
  int num_block_columns = 0;
  std::vector<const JBLOCK*> block_rows;
  std::array<std::uint16_t, kDctSize * kDctSize> quantization{};
  float pixels_per_block_x = 8.0F;  // Of the full resolution.
  float pixels_per_block_y = 8.0F;

  float Mean(int column, int row) const {
    return 128.0F + static_cast<float>(block_rows[static_cast<std::size_t>(row)][column][0] *
                                       quantization[0]) /
                        8.0F;
  }
  // Of the block that holds a full-resolution pixel.
  float MeanAt(float x_px, float y_px) const {
    const int column = static_cast<int>((x_px + 0.5F) / pixels_per_block_x);
    const int row = static_cast<int>((y_px + 0.5F) / pixels_per_block_y);
    return Mean(std::clamp(column, 0, num_block_columns - 1),
                std::clamp(row, 0, static_cast<int>(block_rows.size()) - 1));
  }
};

std::uint8_t ToByte(float value) {
  return static_cast<std::uint8_t>(std::lround(std::clamp(value, 0.0F, 255.0F)));
}

class JpegRaster : public PhotoRaster {
 public:
  JpegRaster(std::unique_ptr<JpegReader> reader, std::vector<Plane> planes)
      : reader_(std::move(reader)), planes_(std::move(planes)) {}

  FloatImage Gray(int eighths, int num_threads) const override {
    const Plane& luma = planes_[0];
    const auto scaled = [eighths](unsigned int size) {
      return (static_cast<int>(size) * eighths + kDctSize - 1) / kDctSize;
    };
    FloatImage image(scaled(reader_->info().image_width), scaled(reader_->info().image_height));
    const ScaledIdct idct(eighths, luma.quantization.data());
    const int num_block_rows = (image.height() + eighths - 1) / eighths;
    ParallelFor(num_threads, num_block_rows, kBlockRowsPerPart, [&](int begin, int end) {
      std::vector<float> rows(static_cast<std::size_t>(luma.num_block_columns * eighths * eighths));
      const int stride = luma.num_block_columns * eighths;
      for (int block_row = begin; block_row < end; ++block_row) {
        const JBLOCK* blocks = luma.block_rows[static_cast<std::size_t>(block_row)];
        for (int column = 0; column < luma.num_block_columns; ++column) {
          idct.Decode(blocks[column], rows.data() + column * eighths, stride);
        }
        const int first = block_row * eighths;
        for (int y = first; y < std::min(first + eighths, image.height()); ++y) {
          const float* row = rows.data() + (y - first) * stride;
          std::copy(row, row + image.width(), image.Row(y));
          image.FillPadding(y);
        }
      }
    });
    return image;
  }

  // JFIF's YCbCr (ITU-T T.871, section 7).
  Rgb ColorAt(float x_px, float y_px) const override {
    const float luma = planes_[0].MeanAt(x_px, y_px);
    if (planes_.size() == 1) return {ToByte(luma), ToByte(luma), ToByte(luma)};
    const float cb = planes_[1].MeanAt(x_px, y_px) - 128.0F;
    const float cr = planes_[2].MeanAt(x_px, y_px) - 128.0F;
    return {ToByte(luma + 1.402F * cr),
            ToByte(luma - 0.344136F * cb - 0.714136F * cr),
            ToByte(luma + 1.772F * cb)};
  }

 private:
  std::unique_ptr<JpegReader> reader_;  // Owns the coefficients.
  std::vector<Plane> planes_;
};

Plane MakePlane(JpegReader* reader, int component) {
  const jpeg_decompress_struct& info = reader->info();
  const jpeg_component_info& of = info.comp_info[component];
  Plane plane;
  plane.num_block_columns = static_cast<int>(of.width_in_blocks);
  for (int row = 0; row < static_cast<int>(of.height_in_blocks); ++row) {
    plane.block_rows.push_back(reader->BlockRow(component, row));
  }
  if (of.quant_table != nullptr) {
    std::copy_n(of.quant_table->quantval, plane.quantization.size(), plane.quantization.begin());
  }
  plane.pixels_per_block_x =
      8.0F * static_cast<float>(info.max_h_samp_factor) / static_cast<float>(of.h_samp_factor);
  plane.pixels_per_block_y =
      8.0F * static_cast<float>(info.max_v_samp_factor) / static_cast<float>(of.v_samp_factor);
  return plane;
}

// Luma must be at full resolution for its blocks to be 8 x 8 pixels of the photo.
bool IsGrayOrYCbCr(const jpeg_decompress_struct& info) {
  const bool is_gray = info.jpeg_color_space == JCS_GRAYSCALE && info.num_components == 1;
  const bool is_ycc = info.jpeg_color_space == JCS_YCbCr && info.num_components == 3;
  return is_gray || (is_ycc && info.comp_info[0].h_samp_factor == info.max_h_samp_factor &&
                     info.comp_info[0].v_samp_factor == info.max_v_samp_factor);
}

}  // namespace

bool IsJpeg(const std::vector<std::uint8_t>& bytes) {
  return bytes.size() >= 3 && bytes[0] == 0xFF && bytes[1] == 0xD8 && bytes[2] == 0xFF;
}

std::optional<PhotoSize> ReadJpegSize(const std::vector<std::uint8_t>& bytes) {
  JpegReader reader(bytes);
  if (!reader.ReadHeader()) return std::nullopt;
  return PhotoSize{static_cast<int>(reader.info().image_width),
                   static_cast<int>(reader.info().image_height)};
}

DecodedPhoto DecodeJpeg(const std::vector<std::uint8_t>& bytes) {
  auto reader = std::make_unique<JpegReader>(bytes);
  if (!reader->ReadHeader())
    return {nullptr, "the header of the JPEG file is damaged; copy the file from the camera again"};
  if (!IsGrayOrYCbCr(reader->info())) return {};
  const bool is_read = reader->ReadCoefficients();
  if (reader->errors().is_cut_off) {
    return {nullptr, kCutOff};
  }
  if (!is_read || reader->errors().is_damaged) {
    return {nullptr, "the JPEG data are damaged; copy the file from the camera again"};
  }
  std::vector<Plane> planes;
  for (int i = 0; i < reader->info().num_components; ++i) {
    planes.push_back(MakePlane(reader.get(), i));
  }
  return {std::make_unique<JpegRaster>(std::move(reader), std::move(planes)), ""};
}

}  // namespace plumb

// SPDX-FileCopyrightText: 2026 The Plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "image/file_damage.h"

#include <zlib.h>

#include <cstdlib>
#include <cstring>

namespace plumb {
namespace {

using Bytes = std::vector<std::uint8_t>;

bool StartsWith(const Bytes& bytes, const std::string& start) {
  return bytes.size() >= start.size() && std::memcmp(bytes.data(), start.data(), start.size()) == 0;
}

// Integers at any place of a file; 0 beyond its end.
class Reader {
 public:
  Reader(const Bytes& bytes, bool is_big_endian) : bytes_(bytes), is_big_endian_(is_big_endian) {}

  std::uint64_t Unsigned(std::uint64_t at, std::uint64_t num_bytes) const {
    if (!Holds(at, num_bytes)) return 0;
    std::uint64_t value = 0;
    for (std::uint64_t i = 0; i < num_bytes; ++i) {
      value = value << 8 | bytes_[at + (is_big_endian_ ? i : num_bytes - 1 - i)];
    }
    return value;
  }
  std::int32_t Signed32(std::uint64_t at) const {
    return static_cast<std::int32_t>(static_cast<std::uint32_t>(Unsigned(at, 4)));
  }
  bool Holds(std::uint64_t at, std::uint64_t num_bytes) const {
    return num_bytes <= bytes_.size() && at <= bytes_.size() - num_bytes;
  }

 private:
  const Bytes& bytes_;
  bool is_big_endian_;
};

constexpr char kPngStart[] = "\x89PNG\r\n\x1a\n";

// PNG specification, third edition, section 5: length, type, data, CRC of type and data. An
// ancillary chunk, whose type begins with a small letter, is no part of the picture.
std::string FindPngDamage(const Bytes& bytes) {
  const Reader reader(bytes, /*is_big_endian=*/true);
  std::uint64_t at = sizeof(kPngStart) - 1;
  while (true) {
    const std::uint64_t length = reader.Unsigned(at, 4);
    if (!reader.Holds(at, length + 12)) return kCutOff;
    const std::uint8_t* type = bytes.data() + at + 4;
    const uLong crc = crc32_z(0, type, static_cast<z_size_t>(length + 4));
    const bool is_ancillary = (type[0] & 0x20U) != 0;
    if (crc != reader.Unsigned(at + length + 8, 4) && !is_ancillary) {
      return "the PNG data are damaged; copy the file from the camera again";
    }
    if (std::memcmp(type, "IEND", 4) == 0) return {};
    at += length + 12;
  }
}

// Compressions of a BMP; the others are for printers.
constexpr std::uint64_t kRle8 = 1;
constexpr std::uint64_t kRle4 = 2;
constexpr std::uint64_t kBitFields = 3;

// BITMAPINFOHEADER and its successors; uncompressed rows are padded to four bytes.
std::string FindBmpDamage(const Bytes& bytes) {
  const Reader reader(bytes, /*is_big_endian=*/false);
  constexpr std::uint64_t kInfoHeaderBytes = 40;
  if (!reader.Holds(0, 14 + kInfoHeaderBytes)) return kCutOff;
  const std::uint64_t compression = reader.Unsigned(30, 4);
  if (reader.Unsigned(14, 4) < kInfoHeaderBytes) return {};
  const std::int64_t width_px = reader.Signed32(18);
  const std::int64_t height_px = std::abs(std::int64_t{reader.Signed32(22)});
  const std::int64_t bits_per_pixel = reader.Signed32(28) & 0xffff;
  constexpr std::int64_t kMaxSide_px = 1 << 20;  // Products stay far within 64 bits.
  const bool makes_sense = width_px > 0 && width_px <= kMaxSide_px && height_px <= kMaxSide_px &&
                           bits_per_pixel <= 32 && compression <= kBitFields;
  if (!makes_sense) {
    return "the header of the BMP file is damaged; copy the file from the camera again";
  }
  if (compression == kRle8 || compression == kRle4) return {};
  const std::int64_t num_bytes = (width_px * bits_per_pixel + 31) / 32 * 4 * height_px;
  const bool is_whole = reader.Holds(reader.Unsigned(10, 4), static_cast<std::uint64_t>(num_bytes));
  return is_whole ? std::string() : kCutOff;
}

// One field of a TIFF directory (TIFF 6.0, section 2).
struct TiffField {
  std::uint64_t count = 0;
  std::uint64_t value_bytes = 0;
  std::uint64_t values_at = 0;
};

TiffField ReadTiffField(const Reader& reader, std::uint64_t at) {
  TiffField field;
  field.count = reader.Unsigned(at + 4, 4);
  field.value_bytes = reader.Unsigned(at + 2, 2) == 3 ? 2 : 4;  // SHORT or LONG.
  const bool is_inline = field.count * field.value_bytes <= 4;
  field.values_at = is_inline ? at + 8 : reader.Unsigned(at + 8, 4);
  return field;
}

// The strips or tiles of the first picture.
std::string FindTiffDamage(const Bytes& bytes) {
  const Reader reader(bytes, /*is_big_endian=*/bytes[0] == 'M');
  const std::uint64_t directory = reader.Unsigned(4, 4);
  const std::uint64_t num_fields = reader.Unsigned(directory, 2);
  if (!reader.Holds(directory, 2 + 12 * num_fields)) return kCutOff;
  TiffField offsets;
  TiffField sizes;
  for (std::uint64_t i = 0; i < num_fields; ++i) {
    const std::uint64_t at = directory + 2 + 12 * i;
    const std::uint64_t tag = reader.Unsigned(at, 2);
    if (tag == 273 || tag == 324)
      offsets = ReadTiffField(reader, at);                            // StripOffsets, TileOffsets.
    if (tag == 279 || tag == 325) sizes = ReadTiffField(reader, at);  // StripByteCounts, Tile….
  }
  if (!reader.Holds(offsets.values_at, offsets.count * offsets.value_bytes)) return kCutOff;
  for (std::uint64_t i = 0; i < offsets.count && i < sizes.count; ++i) {
    const std::uint64_t offset =
        reader.Unsigned(offsets.values_at + i * offsets.value_bytes, offsets.value_bytes);
    const std::uint64_t size =
        reader.Unsigned(sizes.values_at + i * sizes.value_bytes, sizes.value_bytes);
    if (!reader.Holds(offset, size)) return kCutOff;
  }
  return {};
}

}  // namespace

std::string FindFileDamage(const Bytes& bytes) {
  if (StartsWith(bytes, kPngStart)) return FindPngDamage(bytes);
  if (StartsWith(bytes, "BM")) return FindBmpDamage(bytes);
  const bool is_tiff = StartsWith(bytes, {"II*\0", 4}) || StartsWith(bytes, {"MM\0*", 4});
  return is_tiff ? FindTiffDamage(bytes) : std::string();
}

}  // namespace plumb

// SPDX-FileCopyrightText: 2026 The Plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "plumbline/export/ply.h"

#include "plumbline/common/atomic_file.h"

namespace plumb {

static_assert(__BYTE_ORDER__ == __ORDER_LITTLE_ENDIAN__, "the header says little-endian");

void ExportPly(const std::vector<LandmarkState>& landmarks,
               const std::string& path,
               const std::vector<std::string>& comments) {
  std::string text = "ply\nformat binary_little_endian 1.0\ncomment Plumbline landmarks\n";
  for (const std::string& comment : comments) text += "comment " + comment + '\n';
  text += "element vertex " + std::to_string(landmarks.size()) +
          "\nproperty double x\nproperty double y\nproperty double z\n"
          "property uchar red\nproperty uchar green\nproperty uchar blue\nend_header\n";
  for (const LandmarkState& landmark : landmarks) {
    text.append(reinterpret_cast<const char*>(landmark.position_in_map.data()), 3 * sizeof(double));
    text.append(reinterpret_cast<const char*>(landmark.color.data()), landmark.color.size());
  }
  WriteFileAtomically(path, text);
}

}  // namespace plumb

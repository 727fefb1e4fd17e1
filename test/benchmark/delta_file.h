// SPDX-FileCopyrightText: 2026 The Plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstring>
#include <string>
#include <type_traits>
#include <vector>

#include "plumbline/common/atomic_file.h"
#include "plumbline/common/check.h"
#include "plumbline/map/map_delta.h"

namespace plumb::test {

// Deltas as a file of this machine's own bytes, so that a flight need not be mapped again for every
// measurement of what comes after the mapper. Names and lenses are left out.
class DeltaFile {
 public:
  static void Write(const std::vector<MapDelta>& deltas, const std::string& path) {
    DeltaFile file;
    file.Put(deltas.size());
    for (const MapDelta& delta : deltas) file.PutDelta(delta);
    WriteFileAtomically(path, file.bytes_);
  }

  static std::vector<MapDelta> Read(const std::string& path) {
    DeltaFile file;
    const std::vector<std::uint8_t> bytes = ReadFileBytes(path);
    file.bytes_.assign(bytes.begin(), bytes.end());
    std::vector<MapDelta> deltas(file.Get<std::size_t>());
    for (MapDelta& delta : deltas) file.GetDelta(&delta);
    return deltas;
  }

 private:
  template <typename Value>
  void Put(const Value& value) {
    bytes_.append(reinterpret_cast<const char*>(&value), sizeof value);
  }
  template <typename Value>
  Value Get() {
    Value value;
    PLUMB_CHECK_LE(position_ + sizeof value, bytes_.size());
    std::memcpy(reinterpret_cast<char*>(&value), bytes_.data() + position_, sizeof value);
    position_ += sizeof value;
    return value;
  }
  template <typename Value>
  void PutAll(const std::vector<Value>& values) {
    Put(values.size());
    for (const Value& value : values) Put(value);
  }
  template <typename Value>
  void GetAll(std::vector<Value>* values) {
    values->resize(Get<std::size_t>());
    for (Value& value : *values) value = Get<Value>();
  }

  void PutDelta(const MapDelta& delta) {
    Put(delta.sequence);
    Put(delta.is_snapshot);
    PutAll(delta.observations_removed);
    PutAll(delta.landmarks_removed);
    PutAll(delta.views_removed);
    Put(delta.views_set.size());
    for (const ViewState& view : delta.views_set) {
      Put(view.photo);
      Put(view.cam_from_map.rotation.coeffs());
      Put(view.cam_from_map.translation);
    }
    PutAll(delta.landmarks_set);
    PutAll(delta.observations_added);
  }
  void GetDelta(MapDelta* delta) {
    delta->sequence = Get<std::uint32_t>();
    delta->is_snapshot = Get<bool>();
    GetAll(&delta->observations_removed);
    GetAll(&delta->landmarks_removed);
    GetAll(&delta->views_removed);
    delta->views_set.resize(Get<std::size_t>());
    for (ViewState& view : delta->views_set) {
      view.photo = Get<PhotoId>();
      view.cam_from_map.rotation.coeffs() = Get<Eigen::Vector4d>();
      view.cam_from_map.translation = Get<Eigen::Vector3d>();
    }
    GetAll(&delta->landmarks_set);
    GetAll(&delta->observations_added);
  }

  std::string bytes_;
  std::size_t position_ = 0;
};

}  // namespace plumb::test

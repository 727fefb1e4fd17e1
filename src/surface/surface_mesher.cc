// SPDX-FileCopyrightText: 2026 The Plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "plumbline/surface/surface_mesher.h"

#include "plumbline/common/options.h"
#include "plumbline/common/stopwatch.h"
#include "surface/labelled_cells.h"
#include "surface/surface_mesh.h"

namespace plumb {

class SurfaceMesher::Impl {
 public:
  explicit Impl(const SurfaceOptions& options) : cells_(options), mesh_(options) {}

  SurfaceUpdate Apply(const MapDelta& delta) {
    SurfaceUpdate update;
    update.report.map_sequence = delta.sequence;
    cells_.Apply(delta, &update.report);
    const Stopwatch watch;
    update.mesh = mesh_.Update(cells_);
    update.mesh.is_snapshot = delta.is_snapshot;
    Number(&update.mesh, ++sequence_, delta.sequence);
    update.report.num_faces = mesh_.num_faces();
    update.report.num_faces_checked = mesh_.num_checked();
    update.report.mesh_s = watch.Seconds();
    map_sequence_ = delta.sequence;
    return update;
  }

  MeshDelta Snapshot() const {
    MeshDelta snapshot = mesh_.Snapshot(cells_.scene());
    Number(&snapshot, sequence_, map_sequence_);
    return snapshot;
  }

  const LabelledCells& cells() const { return cells_; }
  std::uint32_t sequence() const { return sequence_; }
  void set_sequence(std::uint32_t sequence) { sequence_ = sequence; }
  std::uint32_t map_sequence() const { return map_sequence_; }

 private:
  static void Number(MeshDelta* delta, std::uint32_t sequence, std::uint32_t map_sequence) {
    delta->sequence = sequence;
    delta->map_sequence = map_sequence;
  }

  LabelledCells cells_;
  SurfaceMesh mesh_;
  std::uint32_t sequence_ = 0;
  std::uint32_t map_sequence_ = 0;
};

SurfaceMesher::SurfaceMesher(const SurfaceOptions& options) {
  ThrowIfProblems("surface", options.Problems());
  impl_ = std::make_unique<Impl>(options);
}

SurfaceMesher::~SurfaceMesher() = default;

std::optional<SurfaceUpdate> SurfaceMesher::Apply(const MapDelta& delta) {
  if (delta.is_snapshot) {
    const std::uint32_t sequence = impl_->sequence();
    impl_ = std::make_unique<Impl>(impl_->cells().options());
    impl_->set_sequence(sequence);
  } else if (delta.sequence != impl_->map_sequence() + 1) {
    return std::nullopt;
  }
  return impl_->Apply(delta);
}

MeshDelta SurfaceMesher::Snapshot() const { return impl_->Snapshot(); }

std::uint32_t SurfaceMesher::map_sequence() const { return impl_->map_sequence(); }

}  // namespace plumb

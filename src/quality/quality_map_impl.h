// SPDX-FileCopyrightText: 2026 The Plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Geometry>
#include <map>
#include <memory>
#include <optional>
#include <set>
#include <vector>

#include "plumbline/quality/quality_map.h"
#include "quality/bundle_noise.h"
#include "quality/occluders.h"
#include "quality/sight.h"

namespace plumb {

// Of a view and a block: for each face what FindStretches tells, negative where the view is hidden.
using SightRow = std::vector<float>;

class QualityMap::Impl {
 public:
  explicit Impl(const QualityOptions& options);

  QualityUpdate SetCamera(const Camera& camera);
  QualityUpdate Apply(const MapDelta& map_delta, const MeshDelta& mesh_delta);

  const std::map<BlockId, QualityBlock>& blocks() const { return blocks_; }
  const std::map<PhotoId, Rigid3>& views() const { return views_; }
  const std::optional<Camera>& camera() const { return camera_; }
  double noise_px() const { return noise_px_; }

 private:
  struct Look {
    PhotoId photo;
    const internal::Sight* sight = nullptr;
  };

  // At an unchanged block, past changed ones that cover these parts of the image.
  struct LookPast {
    Look look;
    std::vector<internal::ImageRect> before;
  };

  // What of a block is for the making of it only.
  struct BlockState {
    QualityBlock* block = nullptr;
    Eigen::AlignedBox3d box;  // Of the faces, which may reach out of the block.
    internal::FaceArrays faces;
    std::vector<std::uint32_t> ranks;  // Of each face: neighbours have near ones.
    std::map<PhotoId, SightRow> rows;  // Of views that have at least one value other than 0.

    // Of the step that is being done. Blocks are looked at in parallel.
    bool is_changed = false;
    std::vector<Look> looks;
    std::vector<LookPast> looks_past;
  };

  // Whether a view of which a block has a row is hidden from a face.
  struct Test {
    internal::SightLine line;
    float* value = nullptr;  // In the row.
  };

  struct BlockOutcome {
    std::size_t num_rays = 0;
    bool is_touched = false;
    std::vector<PhotoId> new_rows;
  };

  void ApplyViews(const MapDelta& delta);
  void ApplyLens(const MapDelta& delta);
  void UseCamera();
  void SetView(const ViewState& view);
  void RemoveView(PhotoId photo);
  void ForgetSight(PhotoId photo);
  void ApplyMesh(const MeshDelta& delta);
  void SetBlocks(const std::vector<MeshBlock>& blocks);
  static void MeasureFaces(BlockState* state);
  void RemoveBlock(const BlockId& id);
  void NoteChange(const BlockId& id, const Eigen::AlignedBox3d& box);
  void LookAnew();
  std::vector<BlockState*> Prepare();
  std::vector<BlockState*> PlanLooks();
  void PlanLooksPast(const Look& look, const std::vector<Eigen::AlignedBox3d>& changed_boxes);
  BlockOutcome Perform(BlockState* state) const;
  static void CollectBehind(const LookPast& look, BlockState* state, std::vector<Test>* tests);
  static void MakeRow(const Look& look,
                      BlockState* state,
                      std::vector<Test>* tests,
                      BlockOutcome* outcome);
  bool Decide(const BlockState& state, const std::vector<Test>& tests) const;
  bool Summarize(BlockState* state) const;
  void UpdateNoise();
  QualityUpdate Finish();

  QualityOptions options_;
  std::optional<Camera> given_camera_;                  // As calibrated.
  std::optional<LensParameters<double>> refined_lens_;  // As the map has it.
  std::optional<Camera> camera_;                        // Of both, what is used.
  std::shared_ptr<const internal::Lens> lens_;
  std::map<PhotoId, Rigid3> views_;
  std::map<PhotoId, internal::Sight> sights_;  // Empty while there is no camera.
  std::map<BlockId, QualityBlock> blocks_;
  std::map<BlockId, BlockState> states_;
  std::map<PhotoId, std::map<BlockId, BlockState*>> blocks_of_view_;  // Where it has a row.
  internal::Occluders occluders_;
  internal::BundleNoise noise_;
  double noise_px_;

  // Of the step that is being done.
  std::set<PhotoId> changed_views_;
  std::map<BlockId, Eigen::AlignedBox3d> changed_boxes_;  // Before and after.
  std::set<BlockId> touched_blocks_;                      // Their rows are others.
  QualityUpdate update_;
};

}  // namespace plumb

// SPDX-FileCopyrightText: 2026 The Plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <cstdint>
#include <unordered_map>
#include <vector>

#include "plumbline/map/map_delta.h"
#include "plumbline/surface/surface_options.h"
#include "plumbline/surface/surface_report.h"

namespace plumb {

// Number of a landmark in the scene; used again some time after the landmark is gone.
using Slot = std::uint32_t;
constexpr Slot kNoSlot = 0xFFFFFFFF;

// A landmark's ray, from the camera's place on its lattice.
struct SceneRay {
  PhotoId photo;
  Eigen::Vector3d camera = Eigen::Vector3d::Zero();
};

// What a MapDelta means to the tetrahedra: lists of landmarks, each of them at most once in each.
struct SceneChanges {
  std::vector<Slot> removed;  // From where they stood. One that moves is also in `inserted`.
  std::vector<Slot> inserted;
  std::vector<Slot> recast;   // They stand where they stood, but their rays are others.
  std::vector<Slot> redrawn;  // What the mesh shows of them is new or changed.
};

// Landmarks, cameras and the rays between them, as far as they are usable, on their lattices. A
// function of the map's content: the same map gives the same scene, whatever came before.
class RayScene {
 public:
  explicit RayScene(const SurfaceOptions& options) : options_(options) {}

  SceneChanges Apply(const MapDelta& delta, SurfaceReport* report);

  // All of it as one change from nothing.
  std::vector<Slot> PlacedSlots() const;

  LandmarkId IdOf(Slot slot) const { return landmarks_[slot].id; }
  const Eigen::Vector3d& PlaceOf(Slot slot) const { return landmarks_[slot].place; }
  const Eigen::Vector3d& MeshPositionOf(Slot slot) const { return landmarks_[slot].mesh_position; }
  Rgb ColorOf(Slot slot) const { return landmarks_[slot].color; }

  // One for each photo that sees a landmark, in the order of photos.
  void RaysOf(Slot slot, std::vector<SceneRay>* rays) const;

  std::size_t num_slots() const { return landmarks_.size(); }
  std::size_t num_placed() const { return num_placed_; }

 private:
  struct Ray {
    PhotoId photo;
    std::uint32_t feature_idx = 0;
    std::uint32_t view = 0;

    friend bool operator<(const Ray& a, const Ray& b) {
      return a.photo != b.photo ? a.photo < b.photo : a.feature_idx < b.feature_idx;
    }
  };

  struct SceneLandmark {
    LandmarkId id;
    Rgb color = {0, 0, 0};
    bool is_placed = false;
    bool is_dirty = false;
    bool has_new_rays = false;
    bool has_new_color = false;
    int distance_exponent = 0;
    Eigen::Vector3d position = Eigen::Vector3d::Zero();
    Eigen::Vector3d place = Eigen::Vector3d::Zero();
    Eigen::Vector3d mesh_position = Eigen::Vector3d::Zero();
    std::vector<Ray> rays;  // Ascending.
  };

  struct SceneView {
    PhotoId photo;
    bool is_usable = false;
    bool was_usable = false;  // Before the current delta.
    bool is_missed = false;   // Reported as unknown or not finite.
    bool is_changed = false;  // By the current delta.
    bool is_recast = false;
    Eigen::Vector3d center = Eigen::Vector3d::Zero();
    Eigen::Vector3d old_center = Eigen::Vector3d::Zero();
    std::vector<Slot> landmarks;  // Ascending; once for each observation.
  };

  // Whether a landmark stands, and how far its nearest camera is.
  struct Placement {
    bool is_placed = false;
    int distance_exponent = 0;
  };

  void RemoveObservations(const MapDelta& delta);
  void RemoveLandmarks(const MapDelta& delta, SceneChanges* changes);
  void RemoveViews(const MapDelta& delta);
  void SetViews(const MapDelta& delta);
  void SetLandmarks(const MapDelta& delta);
  void AddObservations(const MapDelta& delta);

  std::uint32_t ViewSlot(PhotoId photo);
  void NoteView(std::uint32_t view);
  void DetachFromView(std::uint32_t view, Slot slot);
  void MarkDirty(Slot slot);
  void NoteProblem(SurfaceProblem::Kind kind, LandmarkId landmark, PhotoId photo, LandmarkId other);
  void CheckDoubled(Slot slot);
  void ForgetPosition(Slot slot);
  Placement PlacementOf(const SceneLandmark& landmark);
  void Settle(Slot slot, SceneChanges* changes);
  bool HasMovedCamera(const SceneLandmark& landmark, int distance_exponent);
  int CameraPitchExponent(int distance_exponent) const;

  SurfaceOptions options_;
  std::vector<SceneLandmark> landmarks_;
  std::unordered_map<LandmarkId, Slot> slot_of_landmark_;
  std::vector<Slot> unused_slots_;
  std::vector<Slot> freed_slots_;  // By the last delta; not yet to be used again.
  std::vector<SceneView> views_;
  std::unordered_map<PhotoId, std::uint32_t> view_of_photo_;
  std::unordered_map<std::uint64_t, Slot> slot_at_position_;
  std::vector<Slot> dirty_;
  std::vector<std::uint32_t> changed_views_;
  std::size_t num_placed_ = 0;
  std::size_t num_rays_ = 0;
  SurfaceReport* report_ = nullptr;  // Of the delta being applied.
};

}  // namespace plumb

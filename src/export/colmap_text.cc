// SPDX-FileCopyrightText: 2026 The Plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "plumbline/export/colmap_text.h"

#include <array>
#include <charconv>
#include <unordered_map>
#include <utility>
#include <vector>

#include "plumbline/common/atomic_file.h"
#include "plumbline/export/folder.h"

namespace plumb {
namespace {

constexpr double kPixelShift = 0.5;

// Text with the shortest numbers that read back to the last bit, in any locale.
class TextBuilder {
 public:
  TextBuilder& operator<<(const std::string& text) {
    text_ += text;
    return *this;
  }
  template <typename Number>
  TextBuilder& Field(Number number) {
    if (!text_.empty() && text_.back() != '\n') text_ += ' ';
    std::array<char, 32> buffer;
    const auto end = std::to_chars(buffer.data(), buffer.data() + buffer.size(), number).ptr;
    text_.append(buffer.data(), end);
    return *this;
  }
  const std::string& text() const { return text_; }

 private:
  std::string text_;
};

// What the files say of one observation.
struct TrackElement {
  std::uint32_t image_id = 0;
  std::size_t point2d_idx = 0;
};

struct Track {
  std::vector<TrackElement> elements;
  double sum_error_px = 0.0;
};

// The snapshot, linked up.
struct Model {
  std::unordered_map<PhotoId, std::vector<const ObservationState*>> observations_of_view;
  std::unordered_map<LandmarkId, Track> tracks;
};

std::uint32_t ImageId(PhotoId photo) { return photo.value + 1; }
std::uint32_t Point3dId(LandmarkId landmark) { return landmark.value + 1; }

double ErrorOf(const Camera& camera,
               const Eigen::Vector3d& point_in_cam,
               const Eigen::Vector2f& seen) {
  const std::optional<Eigen::Vector2d> pixel = camera.Project(point_in_cam);
  // The map culls a point behind its camera; should one slip in, it must not look good.
  return pixel ? (*pixel - seen.cast<double>()).norm() : camera.width_px();
}

Model LinkUp(const MapDelta& snapshot, const Camera& camera) {
  std::unordered_map<PhotoId, const ViewState*> views;
  for (const ViewState& view : snapshot.views_set) views[view.photo] = &view;
  std::unordered_map<LandmarkId, const LandmarkState*> landmarks;
  for (const LandmarkState& landmark : snapshot.landmarks_set) landmarks[landmark.id] = &landmark;
  Model model;
  for (const ObservationState& seen : snapshot.observations_added) {
    const Rigid3& cam_from_map = views.at(seen.photo)->cam_from_map;
    const Eigen::Vector3d& point_in_map = landmarks.at(seen.landmark)->position_in_map;
    std::vector<const ObservationState*>& of_view = model.observations_of_view[seen.photo];
    Track& track = model.tracks[seen.landmark];
    track.elements.push_back({ImageId(seen.photo), of_view.size()});
    track.sum_error_px += ErrorOf(camera, cam_from_map * point_in_map, seen.pixel);
    of_view.push_back(&seen);
  }
  return model;
}

std::string CamerasText(const Camera& camera) {
  const LensParameters<double>& lens = camera.lens();
  const auto any = [&](std::size_t first, std::size_t last) {
    for (std::size_t i = first; i <= last; ++i) {
      if (lens[i] != 0.0) return true;
    }
    return false;
  };
  std::string model = "PINHOLE";
  std::size_t num_parameters = kCy + 1;
  if (any(kK3, kK6)) {
    model = "FULL_OPENCV";
    num_parameters = kK6 + 1;
  } else if (any(kK1, kP2)) {
    model = "OPENCV";
    num_parameters = kP2 + 1;
  }
  TextBuilder text;
  text << "# CAMERA_ID, MODEL, WIDTH, HEIGHT, PARAMS[]\n1 " + model;
  text.Field(camera.width_px()).Field(camera.height_px());
  for (std::size_t i = 0; i < num_parameters; ++i) {
    text.Field(lens[i] + (i == kCx || i == kCy ? kPixelShift : 0.0));
  }
  text << "\n";
  return text.text();
}

std::string ImagesText(const MapDelta& snapshot, const Model& model) {
  TextBuilder text;
  text << "# IMAGE_ID, QW, QX, QY, QZ, TX, TY, TZ, CAMERA_ID, NAME\n"
          "# POINTS2D[] as (X, Y, POINT3D_ID)\n";
  for (const ViewState& view : snapshot.views_set) {
    const Eigen::Quaterniond& q = view.cam_from_map.rotation;
    const Eigen::Vector3d& t = view.cam_from_map.translation;
    text.Field(ImageId(view.photo)).Field(q.w()).Field(q.x()).Field(q.y()).Field(q.z());
    text.Field(t.x()).Field(t.y()).Field(t.z()).Field(1);
    text << ' ' + view.name + '\n';
    const auto observations = model.observations_of_view.find(view.photo);
    if (observations != model.observations_of_view.end()) {
      for (const ObservationState* seen : observations->second) {
        text.Field(static_cast<double>(seen->pixel.x()) + kPixelShift);
        text.Field(static_cast<double>(seen->pixel.y()) + kPixelShift);
        text.Field(Point3dId(seen->landmark));
      }
    }
    text << "\n";
  }
  return text.text();
}

std::string PointsText(const MapDelta& snapshot, const Model& model) {
  TextBuilder text;
  text << "# POINT3D_ID, X, Y, Z, R, G, B, ERROR, TRACK[] as (IMAGE_ID, POINT2D_IDX)\n";
  for (const LandmarkState& landmark : snapshot.landmarks_set) {
    const auto found = model.tracks.find(landmark.id);
    if (found == model.tracks.end()) continue;  // COLMAP knows no point that nothing sees.
    const Track& track = found->second;
    const Eigen::Vector3d& position = landmark.position_in_map;
    text.Field(Point3dId(landmark.id)).Field(position.x()).Field(position.y()).Field(position.z());
    for (const std::uint8_t channel : landmark.color) text.Field(static_cast<int>(channel));
    text.Field(track.sum_error_px / static_cast<double>(track.elements.size()));
    for (const TrackElement& element : track.elements) {
      text.Field(element.image_id).Field(element.point2d_idx);
    }
    text << "\n";
  }
  return text.text();
}

}  // namespace

Camera CameraOf(const MapDelta& snapshot, const Camera& camera) {
  if (!snapshot.lens) return camera;
  return {camera.name(), camera.width_px(), camera.height_px(), camera.model(), *snapshot.lens};
}

void ExportColmapText(const MapDelta& snapshot, const Camera& camera, const std::string& folder) {
  MakeExportFolder(folder);
  const Camera refined = CameraOf(snapshot, camera);
  const Model model = LinkUp(snapshot, refined);
  WriteFileAtomically(folder + "/cameras.txt", CamerasText(refined));
  WriteFileAtomically(folder + "/images.txt", ImagesText(snapshot, model));
  WriteFileAtomically(folder + "/points3D.txt", PointsText(snapshot, model));
}

}  // namespace plumb

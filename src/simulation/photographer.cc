// SPDX-FileCopyrightText: 2026 The Plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "plumbline/simulation/photographer.h"

#include <algorithm>

#include "plumbline/common/check.h"
#include "plumbline/common/options.h"
#include "plumbline/simulation/sensor.h"
#include "simulation/clearance.h"
#include "simulation/random_numbers.h"
#include "simulation/utc_time.h"

namespace plumb {
namespace {

enum RandomUse : std::uint64_t { kNoiseUse = 0x6E6F697365 };

constexpr double kFullFrameWidth_mm = 36.0;

Scenario Checked(const Scenario& scenario) {
  ThrowIfProblems("scenario", scenario.Problems());
  return scenario;
}

World BuildWorld(const Scenario& scenario) {
  return scenario.floor.num_photos > 0 ? BuildMarkerFloor(scenario.floor)
                                       : BuildFacade(scenario.facade);
}

std::vector<PlannedPhoto> PlanPhotos(const Scenario& scenario, const Camera& camera) {
  if (scenario.floor.num_photos > 0) {
    return PlanFloorPhotos(scenario.floor, camera, *ParseUtcTime(scenario.flight.start_time));
  }
  return PlanFlight(
      scenario.flight, camera, {scenario.facade.width_m, scenario.facade.depth_m}, scenario.seed);
}

}  // namespace

Photographer::Photographer(const Scenario& scenario)
    : scenario_(Checked(scenario)),
      camera_(MakeTrueCamera(scenario.lens)),
      world_(BuildWorld(scenario)),
      renderer_(world_),
      photos_(PlanPhotos(scenario, camera_)),
      telemetry_(SimulateTelemetry(scenario.navigation, photos_, scenario.seed)) {
  if (scenario.floor.num_photos == 0) CheckClearance(renderer_, photos_);
  sample_of_photo_.resize(photos_.size());
  for (std::size_t i = 0; i < telemetry_.size(); ++i) {
    const int photo_idx = telemetry_[i].photo_idx;
    if (photo_idx >= 0) sample_of_photo_[static_cast<std::size_t>(photo_idx)] = i;
  }
}

const std::optional<GeodeticPosition>& Photographer::MeasuredPosition(std::size_t idx) const {
  PLUMB_CHECK_LT(idx, photos_.size());
  return telemetry_[sample_of_photo_[idx]].position;
}

// Median depth of what nine rays over the photo meet; the planned distance where most meet the sky.
double Photographer::SceneDistance(const PlannedPhoto& photo) const {
  const Rigid3 world_from_cam = photo.cam_from_world.Inverse();
  std::vector<double> depths;
  for (int i = 0; i < 9; ++i) {
    const Eigen::Vector2i third(i % 3, i / 3);
    const Eigen::Vector2d share = (third.cast<double>().array() + 0.5) / 3.0;
    const Eigen::Vector2d pixel(share.x() * camera_.width_px(), share.y() * camera_.height_px());
    const std::optional<Eigen::Vector2d> xy = camera_.Unproject(pixel);
    if (!xy) continue;
    const Eigen::Vector3d direction = world_from_cam.rotation * xy->homogeneous();
    const std::optional<RayHit> hit = renderer_.Cast(world_from_cam.translation, direction);
    if (hit) depths.push_back((photo.cam_from_world * hit->point_in_world).z());
  }
  if (depths.size() < 5) return photo.distance_m;
  std::nth_element(depths.begin(), depths.begin() + depths.size() / 2, depths.end());
  return depths[depths.size() / 2];
}

std::vector<std::uint8_t> Photographer::Take(std::size_t idx, int num_threads) const {
  PLUMB_CHECK_LT(idx, photos_.size());
  const PlannedPhoto& photo = photos_[idx];
  const cv::Mat radiance = renderer_.Render(
      camera_, photo.cam_from_world, scenario_.light, scenario_.samples_per_axis, num_threads);
  const Exposure exposure = MeterExposure(scenario_.sensor, radiance);
  ShotConditions conditions;
  conditions.velocity_in_cam_m_s = photo.velocity_in_cam_m_s;
  conditions.turn_rate_in_cam_rad_s = photo.turn_rate_in_cam_rad_s;
  conditions.scene_distance_m = SceneDistance(photo);
  conditions.focal_length_mm = scenario_.lens.focal_length_mm;
  conditions.noise_seed = DeriveSeed(scenario_.seed, kNoiseUse, idx);
  const cv::Mat picture =
      ExposePhoto(scenario_.sensor, camera_, radiance, exposure, conditions, num_threads);
  const double focal_35mm =
      scenario_.lens.focal_length_mm * kFullFrameWidth_mm / scenario_.lens.sensor_width_mm;
  return EncodePhoto(
      scenario_.sensor,
      picture,
      exposure,
      {photo.exposure_time, scenario_.lens.focal_length_mm, focal_35mm, MeasuredPosition(idx)});
}

}  // namespace plumb

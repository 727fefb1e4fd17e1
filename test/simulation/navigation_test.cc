// SPDX-FileCopyrightText: 2026 The Plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "plumbline/simulation/navigation.h"

#include <gtest/gtest.h>

#include "test/support/synthetic_scene.h"

namespace plumb {
namespace {

std::vector<PlannedPhoto> SomeFlight() {
  FlightOptions options;
  options.legs.resize(1);
  options.legs[0].num_photos = 200;
  options.legs[0].pilot.attitude_jitter_deg = 0.0;
  return PlanFlight(options, test::MakeCamera(), {20.0, 8.0}, 1);
}

NavigationOptions Perfect() {
  NavigationOptions options;
  options.gps_noise_horizontal_m = options.gps_noise_vertical_m = 0.0;
  options.gps_bias_horizontal_m = options.gps_bias_vertical_m = 0.0;
  options.attitude_noise_deg = options.attitude_bias_deg = 0.0;
  return options;
}

TEST(ToGeodetic, AgreesWithTheEllipsoid) {
  NavigationOptions options;
  options.origin_lat_deg = 0.0;
  options.origin_lon_deg = 10.0;
  options.origin_alt_ellipsoid_m = 100.0;
  // On the equator a degree east is 2 pi (a + h) / 360, a = 6378137 m; north, 110574 m (WGS 84).
  const GeodeticPosition east = ToGeodetic(options, {1.0, 0.0, 0.0});
  EXPECT_NEAR(east.lon_deg - 10.0, 360.0 / (2.0 * 3.14159265358979 * 6378237.0), 1e-12);
  EXPECT_NEAR(east.lat_deg, 0.0, 1e-12);
  const GeodeticPosition north = ToGeodetic(options, {0.0, 100.0, 7.0});
  EXPECT_NEAR(north.lat_deg, 100.0 / (110574.3 + 1.75), 1e-8);
  EXPECT_NEAR(*north.alt_m, 107.0, 1e-3);
}

TEST(SimulateTelemetry, PerfectInstrumentsTellTheTruth) {
  const std::vector<PlannedPhoto> photos = SomeFlight();
  const NavigationOptions options = Perfect();
  std::size_t num_photos = 0;
  for (const TelemetrySample& sample : SimulateTelemetry(options, photos, 1)) {
    if (sample.photo_idx < 0) continue;
    const PlannedPhoto& photo = photos[num_photos++];
    EXPECT_EQ(sample.time, photo.exposure_time);
    const GeodeticPosition truth = ToGeodetic(options, photo.cam_from_world.TargetOriginInSource());
    EXPECT_NEAR(sample.position->lat_deg, truth.lat_deg, 1e-12);
    EXPECT_NEAR(*sample.position->alt_m, *truth.alt_m, 1e-6);
    // Forward along the world's y, left along -x, up along z.
    EXPECT_LT((sample.enu_from_body_rotation * Eigen::Vector3d::UnitX() - Eigen::Vector3d::UnitY())
                  .norm(),
              1e-9);
    EXPECT_LT((sample.enu_from_body_rotation * Eigen::Vector3d::UnitZ() - Eigen::Vector3d::UnitZ())
                  .norm(),
              1e-9);
  }
  EXPECT_EQ(num_photos, photos.size());
}

TEST(SimulateTelemetry, NoiseAndBiasHaveTheirSizes) {
  const std::vector<PlannedPhoto> photos = SomeFlight();
  NavigationOptions options = Perfect();
  options.gps_noise_vertical_m = 0.6;
  options.attitude_noise_deg = 0.3;
  double sum2 = 0.0;
  double turns2 = 0.0;
  for (const TelemetrySample& sample : SimulateTelemetry(options, photos, 1)) {
    if (sample.photo_idx < 0) continue;
    const PlannedPhoto& photo = photos[static_cast<std::size_t>(sample.photo_idx)];
    const double truth_m = *ToGeodetic(options, photo.cam_from_world.TargetOriginInSource()).alt_m;
    sum2 += std::pow(*sample.position->alt_m - truth_m, 2);
    const Eigen::Vector3d forward = sample.enu_from_body_rotation * Eigen::Vector3d::UnitX();
    turns2 += forward.x() * forward.x();
  }
  const auto count = static_cast<double>(photos.size());
  EXPECT_NEAR(std::sqrt(sum2 / count), 0.6, 0.1);
  EXPECT_NEAR(std::sqrt(turns2 / count) * 180.0 / 3.14159265, 0.3, 0.05);
  options = Perfect();
  options.gps_bias_vertical_m = 2.5;
  const auto first = SimulateTelemetry(options, photos, 1);
  const auto other = SimulateTelemetry(options, photos, 2);
  const auto plain = SimulateTelemetry(Perfect(), photos, 1);
  EXPECT_NE(*first[0].position->alt_m, *other[0].position->alt_m);
  EXPECT_NEAR(*first.front().position->alt_m - *plain.front().position->alt_m,
              *first.back().position->alt_m - *plain.back().position->alt_m,
              1e-3);
}

TEST(SimulateTelemetry, WithoutGpsThereIsNoFix) {
  NavigationOptions options;
  options.gps = false;
  options.rate_hz = 0.0;
  const std::vector<PlannedPhoto> photos = SomeFlight();
  const std::vector<TelemetrySample> samples = SimulateTelemetry(options, photos, 1);
  EXPECT_EQ(samples.size(), photos.size());
  EXPECT_FALSE(samples[0].position);
}

}  // namespace
}  // namespace plumb

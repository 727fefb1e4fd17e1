// SPDX-FileCopyrightText: 2026 The Plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "plumbline/simulation/navigation.h"

#include <proj.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <sstream>
#include <stdexcept>

#include "plumbline/common/options.h"
#include "simulation/random_numbers.h"

namespace plumb {
namespace {

constexpr double kRadPerDeg = 3.14159265358979323846 / 180.0;

enum RandomUse : std::uint64_t { kBiasUse = 0x62696173, kSampleUse = 0x73616D706C65 };

// East, north, up about the origin to WGS 84.
class LocalFrame {
 public:
  explicit LocalFrame(const NavigationOptions& options)
      : context_(proj_context_create(), proj_context_destroy), transform_(nullptr, proj_destroy) {
    std::ostringstream steps;
    steps.precision(17);
    steps << "+proj=pipeline +ellps=WGS84 +step +inv +proj=topocentric +lat_0="
          << options.origin_lat_deg << " +lon_0=" << options.origin_lon_deg
          << " +h_0=" << options.origin_alt_ellipsoid_m << " +step +inv +proj=cart";
    transform_.reset(proj_create(context_.get(), steps.str().c_str()));
    if (!transform_) {
      const int code = proj_context_errno(context_.get());
      throw std::runtime_error(
          std::string("PROJ knows no local frame about the navigation's origin: ") +
          proj_context_errno_string(context_.get(), code));
    }
  }

  GeodeticPosition ToGeodetic(const Eigen::Vector3d& enu_m) const {
    const PJ_COORD place =
        proj_trans(transform_.get(), PJ_FWD, proj_coord(enu_m.x(), enu_m.y(), enu_m.z(), 0.0));
    return {place.lpz.phi / kRadPerDeg, place.lpz.lam / kRadPerDeg, place.lpz.z};
  }

 private:
  std::unique_ptr<PJ_CONTEXT, decltype(&proj_context_destroy)> context_;
  std::unique_ptr<PJ, decltype(&proj_destroy)> transform_;
};

struct TruePlace {
  Eigen::Vector3d center_in_world;
  Eigen::Quaterniond world_from_body;
};

// Body x forward, y left, z up; camera x right, y down, z forward.
TruePlace PlaceOf(const Rigid3& cam_from_world) {
  Eigen::Matrix3d cam_from_body;
  cam_from_body << 0, -1, 0, 0, 0, -1, 1, 0, 0;
  return {cam_from_world.TargetOriginInSource(),
          cam_from_world.rotation.conjugate() * Eigen::Quaterniond(cam_from_body)};
}

Eigen::Vector3d HorizontalAndVertical(double horizontal_m,
                                      double vertical_m,
                                      RandomNumbers* random) {
  return random->Normal3(1.0).cwiseProduct(Eigen::Vector3d(horizontal_m, horizontal_m, vertical_m));
}

Eigen::Quaterniond SmallTurn(double sigma_deg, RandomNumbers* random) {
  const Eigen::Vector3d turn = random->Normal3(sigma_deg * kRadPerDeg);
  return Eigen::Quaterniond(Eigen::AngleAxisd(turn.norm(), turn.stableNormalized()));
}

// What is wrong with one flight's instruments all the time.
class Instruments {
 public:
  Instruments(const NavigationOptions& options, std::uint64_t seed)
      : options_(options), frame_(options), seed_(seed) {
    RandomNumbers random(DeriveSeed(seed, kBiasUse, 0));
    bias_m_ =
        HorizontalAndVertical(options.gps_bias_horizontal_m, options.gps_bias_vertical_m, &random);
    bias_turn_ = SmallTurn(options.attitude_bias_deg, &random);
  }

  TelemetrySample Measure(const TruePlace& place, Timestamp time, int photo_idx) const {
    RandomNumbers random(DeriveSeed(seed_, kSampleUse, static_cast<std::uint64_t>(time.ns)));
    TelemetrySample sample{time, std::nullopt, Eigen::Quaterniond::Identity(), photo_idx};
    const Eigen::Vector3d noise_m = HorizontalAndVertical(
        options_.gps_noise_horizontal_m, options_.gps_noise_vertical_m, &random);
    if (options_.gps)
      sample.position = frame_.ToGeodetic(place.center_in_world + bias_m_ + noise_m);
    sample.enu_from_body_rotation =
        place.world_from_body * bias_turn_ * SmallTurn(options_.attitude_noise_deg, &random);
    return sample;
  }

 private:
  NavigationOptions options_;
  LocalFrame frame_;
  std::uint64_t seed_;
  Eigen::Vector3d bias_m_;
  Eigen::Quaterniond bias_turn_;
};

TruePlace Between(const TruePlace& a, const TruePlace& b, double share) {
  return {a.center_in_world + share * (b.center_in_world - a.center_in_world),
          a.world_from_body.slerp(share, b.world_from_body)};
}

}  // namespace

std::vector<std::string> NavigationOptions::Problems() const {
  ProblemList problems;
  problems.Require(
      std::abs(origin_lat_deg) <= 89.0, "origin_lat_deg", "in [-89, 89]", origin_lat_deg);
  problems.Require(
      std::abs(origin_lon_deg) <= 180.0, "origin_lon_deg", "in [-180, 180]", origin_lon_deg);
  problems.Require(std::abs(origin_alt_ellipsoid_m) <= 10'000.0,
                   "origin_alt_ellipsoid_m",
                   "in [-10000, 10000]",
                   origin_alt_ellipsoid_m);
  const auto require = [&](double value, double high, const char* field, const char* bound) {
    problems.Require(value >= 0.0 && value <= high, field, bound, value);
  };
  require(gps_noise_horizontal_m, 1000.0, "gps_noise_horizontal_m", "in [0, 1000]");
  require(gps_noise_vertical_m, 1000.0, "gps_noise_vertical_m", "in [0, 1000]");
  require(gps_bias_horizontal_m, 1000.0, "gps_bias_horizontal_m", "in [0, 1000]");
  require(gps_bias_vertical_m, 1000.0, "gps_bias_vertical_m", "in [0, 1000]");
  require(attitude_noise_deg, 90.0, "attitude_noise_deg", "in [0, 90]");
  require(attitude_bias_deg, 90.0, "attitude_bias_deg", "in [0, 90]");
  require(rate_hz, 1000.0, "rate_hz", "in [0, 1000]");
  return problems.Take();
}

std::vector<TelemetrySample> SimulateTelemetry(const NavigationOptions& options,
                                               const std::vector<PlannedPhoto>& photos,
                                               std::uint64_t seed) {
  ThrowIfProblems("navigation", options.Problems());
  const Instruments instruments(options, seed);
  std::vector<TelemetrySample> samples;
  for (std::size_t i = 0; i < photos.size(); ++i) {
    const TruePlace place = PlaceOf(photos[i].cam_from_world);
    const Timestamp time = photos[i].exposure_time;
    samples.push_back(instruments.Measure(place, time, static_cast<int>(i)));
    if (i + 1 == photos.size()) break;
    const TruePlace next = PlaceOf(photos[i + 1].cam_from_world);
    const double gap_s = 1e-9 * static_cast<double>(photos[i + 1].exposure_time.ns - time.ns);
    const int num_between = std::max(0, static_cast<int>(std::ceil(gap_s * options.rate_hz)) - 1);
    for (int k = 1; k <= num_between; ++k) {
      const double share = k / (num_between + 1.0);
      const Timestamp at{time.ns + std::llround(1e9 * share * gap_s)};
      samples.push_back(instruments.Measure(Between(place, next, share), at, -1));
    }
  }
  return samples;
}

GeodeticPosition ToGeodetic(const NavigationOptions& options,
                            const Eigen::Vector3d& point_in_world) {
  return LocalFrame(options).ToGeodetic(point_in_world);
}

}  // namespace plumb

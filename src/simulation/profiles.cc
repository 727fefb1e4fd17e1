// SPDX-FileCopyrightText: 2026 The Plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "simulation/profiles.h"

#include <cmath>

namespace plumb {
namespace {

constexpr double kPi = 3.14159265358979323846;
constexpr int kNumArcSteps = 5;

// Draws a profile in shares of its height and its projection.
class ProfilePen {
 public:
  ProfilePen(double height_m, double out_m) : size_m_(height_m, out_m) {
    profile_.emplace_back(0.0, -kEmbedded_m);
  }

  ProfilePen& To(double across, double out) {
    at_ = {across, out};
    profile_.emplace_back(across * size_m_.x(), out * size_m_.y());
    return *this;
  }
  // A quarter round that first goes outwards or inwards, then up.
  ProfilePen& OutThenUp(double across, double out) { return Arc(across, out, true); }
  // A quarter round that first goes up.
  ProfilePen& UpThenOut(double across, double out) { return Arc(across, out, false); }
  // An S of two quarter rounds: hollow below, round above.
  ProfilePen& Cyma(double across, double out) {
    const Eigen::Vector2d middle = 0.5 * (at_ + Eigen::Vector2d(across, out));
    return UpThenOut(middle.x(), middle.y()).OutThenUp(across, out);
  }
  Profile Finish() {
    profile_.emplace_back(profile_.back().x(), -kEmbedded_m);
    return std::move(profile_);
  }

 private:
  ProfilePen& Arc(double across, double out, bool out_first) {
    const Eigen::Vector2d start = at_;
    for (int k = 1; k <= kNumArcSteps; ++k) {
      const double angle = 0.5 * kPi * k / kNumArcSteps;
      const double fast = std::sin(angle);
      const double slow = 1.0 - std::cos(angle);
      To(start.x() + (across - start.x()) * (out_first ? slow : fast),
         start.y() + (out - start.y()) * (out_first ? fast : slow));
    }
    return *this;
  }

  Eigen::Vector2d size_m_;
  Eigen::Vector2d at_ = Eigen::Vector2d::Zero();
  Profile profile_;
};

}  // namespace

Profile StringCourseProfile(double height_m, double out_m) {
  return ProfilePen(height_m, out_m)
      .To(0.0, 0.3)
      .To(0.3, 0.3)
      .Cyma(0.6, 0.8)
      .To(0.6, 1.0)
      .To(0.85, 1.0)
      .To(1.0, 0.1)
      .Finish();
}

Profile MainCorniceProfile(double height_m, double out_m) {
  return ProfilePen(height_m, out_m)
      .To(0.0, 0.08)
      .To(0.08, 0.08)
      .OutThenUp(0.2, 0.22)
      .To(0.24, 0.24)
      .To(0.42, 0.24)  // The field of the modillions.
      .To(0.42, 0.72)
      .To(0.62, 0.72)
      .To(0.62, 0.78)
      .Cyma(0.9, 0.97)
      .To(0.9, 1.0)
      .To(1.0, 1.0)
      .Finish();
}

Profile ArchitraveProfile(double width_m, double out_m) {
  return ProfilePen(width_m, out_m)
      .To(0.0, 0.4)
      .To(0.38, 0.4)
      .To(0.38, 0.55)
      .To(0.68, 0.55)
      .Cyma(0.88, 0.9)
      .To(0.88, 1.0)
      .To(1.0, 1.0)
      .Finish();
}

Profile SillProfile(double height_m, double out_m) {
  return ProfilePen(height_m, out_m)
      .To(0.0, 0.55)
      .UpThenOut(0.3, 0.8)
      .To(0.3, 0.93)
      .OutThenUp(0.5, 1.0)
      .To(0.7, 1.0)
      .To(1.0, 0.0)
      .Finish();
}

Profile HoodProfile(double height_m, double out_m) {
  return ProfilePen(height_m, out_m)
      .To(0.0, 0.15)
      .To(0.1, 0.15)
      .OutThenUp(0.3, 0.45)
      .To(0.3, 0.75)
      .To(0.55, 0.75)
      .Cyma(0.85, 1.0)
      .To(0.92, 1.0)
      .To(1.0, 0.1)
      .Finish();
}

Profile PlinthProfile(double height_m, double out_m) {
  const double chamfer = out_m / height_m;
  return ProfilePen(height_m, out_m).To(0.0, 1.0).To(1.0 - chamfer, 1.0).To(1.0, 0.1).Finish();
}

Profile BracketProfile(double height_m, double out_m) {
  return ProfilePen(height_m, out_m)
      .OutThenUp(0.12, 0.22)
      .UpThenOut(0.5, 0.38)
      .To(0.5, 0.42)
      .OutThenUp(0.82, 1.0)
      .To(1.0, 1.0)
      .Finish();
}

Profile FrameProfile(double width_m, double depth_m) {
  constexpr double kRoundedEdge_m = 0.006;
  return {{0.0, -depth_m},
          {0.0, 0.0},
          {width_m - kRoundedEdge_m, 0.0},
          {width_m, -kRoundedEdge_m},
          {width_m, -depth_m}};
}

}  // namespace plumb

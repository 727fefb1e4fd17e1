// SPDX-FileCopyrightText: 2026 The Plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "ros/view_choice.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <stdexcept>

#include "test/support/calibration_scene.h"

namespace plumb::ros_adapter {
namespace {

using ::testing::HasSubstr;

// The markers of a plane seen by a camera that stands above (0, 0), in a steady video.
class ViewChoiceTest : public ::testing::Test {
 protected:
  VideoView See(const Eigen::Vector3d& place, double tilt_deg = 0.0) {
    Random random(3);
    const auto plates = test::StrewnPlates(&random);
    test::CalibrationSceneOptions scene;
    scene.noise_factor = 0.0;
    const Eigen::Quaterniond rotation =
        Eigen::AngleAxisd(tilt_deg * M_PI / 180.0, Eigen::Vector3d::UnitX()) *
        Eigen::Quaterniond(0.0, 1.0, 0.0, 0.0);
    const Rigid3 cam_from_plane(
        rotation,
        Eigen::Vector3d(0, 0, place.z()) - rotation * Eigen::Vector3d(place.x(), place.y(), 0));
    stamp_s_ += 0.1;
    return {stamp_s_,
            scene.camera.width_px(),
            scene.camera.height_px(),
            test::SeePlates(scene, plates, cam_from_plane, "", &random).markers,
            0.8};
  }

  // Looks there long enough to be still.
  std::string Settle(const Eigen::Vector3d& place, double tilt_deg = 0.0) {
    choice_.Judge(See(place, tilt_deg));
    return choice_.Judge(See(place, tilt_deg));
  }

  using Random = test::Random;

  ViewChoice choice_{ViewChoiceOptions()};
  double stamp_s_ = 100.0;
};

const Eigen::Vector3d kAbove(0.0, 0.0, 25.0);

TEST_F(ViewChoiceTest, TakesTheFirstViewAndNotTheSameAgain) {
  EXPECT_EQ(choice_.Judge(See(kAbove)), "");
  EXPECT_THAT(choice_.Judge(See(kAbove)), HasSubstr("like one"));
}

TEST_F(ViewChoiceTest, TakesAViewFromAnotherPlaceDistanceOrTilt) {
  EXPECT_EQ(choice_.Judge(See(kAbove)), "");
  EXPECT_THAT(Settle({0.5, 0.0, 25.5}), HasSubstr("like one"));
  EXPECT_EQ(Settle({6.0, 0.0, 25.0}), "");
  EXPECT_EQ(Settle({0.0, 0.0, 33.0}), "");
  EXPECT_EQ(Settle(kAbove, 20.0), "");
  EXPECT_THAT(Settle(kAbove, 22.0), HasSubstr("like one"));
  EXPECT_THAT(Settle(kAbove), HasSubstr("like one"));
}

TEST_F(ViewChoiceTest, WaitsUntilTheCameraIsStill) {
  choice_.Judge(See({1.0, 0.0, 25.0}));
  EXPECT_THAT(choice_.Judge(See({8.0, 0.0, 25.0})), HasSubstr("hold still"));
  EXPECT_EQ(choice_.Judge(See({8.0, 0.0, 25.0})), "");
}

TEST_F(ViewChoiceTest, PhotosFarApartInTimeNeedNotBeStill) {
  choice_.Judge(See(kAbove));
  stamp_s_ += 5.0;
  EXPECT_EQ(choice_.Judge(See({6.0, 0.0, 25.0})), "");
}

TEST_F(ViewChoiceTest, ABagPlayedAgainGoesOn) {
  choice_.Judge(See(kAbove));
  stamp_s_ = 50.0;
  EXPECT_EQ(choice_.Judge(See({6.0, 0.0, 25.0})), "");
}

TEST_F(ViewChoiceTest, RefusesBlurredImagesAndTooFewMarkers) {
  VideoView view = See(kAbove);
  view.blur_px = 3.0;
  EXPECT_THAT(choice_.Judge(view), HasSubstr("blurred"));
  view.blur_px.reset();
  view.markers.resize(3);
  EXPECT_THAT(choice_.Judge(view), HasSubstr("only 3"));
  view.markers.clear();
  EXPECT_THAT(choice_.Judge(view), HasSubstr("no markers"));
}

TEST_F(ViewChoiceTest, AMarkerThatIsThereTwiceTellsNothing) {
  VideoView view = See(kAbove);
  view.markers.resize(4);
  view.markers.push_back(view.markers.front());
  EXPECT_THAT(choice_.Judge(view), HasSubstr("only 3"));
}

TEST_F(ViewChoiceTest, StopsWhenThereAreEnough) {
  ViewChoiceOptions options;
  options.max_views = 3;
  ViewChoice choice(options);
  for (int i = 0; i < 3; ++i) {
    stamp_s_ += 5.0;
    EXPECT_EQ(choice.Judge(See(kAbove, 30.0 * i)), "");
  }
  stamp_s_ += 5.0;
  EXPECT_THAT(choice.Judge(See({6.0, 0.0, 25.0})), HasSubstr("enough"));
}

TEST(ViewChoiceOptions, NamesWhatIsOutOfBounds) {
  ViewChoiceOptions options;
  options.max_blur_px = 0.0;
  EXPECT_THROW(ViewChoice{options}, std::invalid_argument);
  EXPECT_THAT(options.Problems(), ::testing::ElementsAre(HasSubstr("max_blur_px")));
}

}  // namespace
}  // namespace plumb::ros_adapter

// SPDX-FileCopyrightText: 2026 The Plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstring>
#include <opencv2/imgcodecs.hpp>

#include "ros/annotated_markers.h"
#include "ros/annotated_photo.h"
#include "ros/latency.h"
#include "ros/map_drawing.h"
#include "ros/picture_banner.h"

namespace plumb::ros_adapter {
namespace {

using ::testing::ElementsAre;
using ::testing::IsEmpty;
using ::testing::Not;

Camera MakeCamera() {
  LensParameters<double> lens{};
  lens[kFx] = lens[kFy] = 1000.0;
  lens[kCx] = 799.5;
  lens[kCy] = 599.5;
  return Camera("camera", 1600, 1200, DistortionModel::kPlumbBob, lens);
}

// Cameras 2 apart along x that look along z; landmark 1 is seen twice, landmark 2 three times.
MapReplica MakeMap() {
  MapDelta delta;
  delta.sequence = 1;
  for (std::uint32_t id = 1; id <= 3; ++id) {
    const Rigid3 map_from_cam(Eigen::Quaterniond::Identity(), {2.0 * id, 0.0, 0.0});
    delta.views_set.push_back({PhotoId{id}, "p", Timestamp{}, map_from_cam.Inverse()});
    delta.observations_added.push_back({LandmarkId{2}, PhotoId{id}, 0, {0.0F, 0.0F}});
    if (id < 3) delta.observations_added.push_back({LandmarkId{1}, PhotoId{id}, 1, {0.0F, 0.0F}});
  }
  delta.landmarks_set = {{LandmarkId{1}, {0, 0, 9}, {}}, {LandmarkId{2}, {1, 2, 3}, {10, 20, 30}}};
  MapReplica map;
  map.Apply(delta);
  return map;
}

std_msgs::Header MakeHeader() {
  std_msgs::Header header;
  header.frame_id = "map";
  return header;
}

std::vector<std::uint8_t> Encode(const cv::Mat& image) {
  std::vector<std::uint8_t> bytes;
  cv::imencode(".png", image, bytes);
  return bytes;
}

TEST(DrawPoints, ShowsPointsOfEnoughPhotosWithTheirColour) {
  const sensor_msgs::PointCloud2 cloud = DrawPoints(MakeMap(), /*min_views=*/3, MakeHeader());
  ASSERT_EQ(cloud.width, 1U);
  float position[3];
  std::memcpy(position, &cloud.data[cloud.fields[0].offset], sizeof position);
  EXPECT_THAT(position, ElementsAre(1.0F, 2.0F, 3.0F));
  std::uint32_t rgb = 0;
  std::memcpy(&rgb, &cloud.data[cloud.fields[3].offset], sizeof rgb);
  EXPECT_EQ(rgb & 0xFFFFFFU, (10U << 16) | (20U << 8) | 30U);
  EXPECT_EQ(DrawPoints(MakeMap(), /*min_views=*/2, MakeHeader()).width, 2U);
}

TEST(DrawFrusta, HighlightsTheNewestAndScalesWithTheSpacing) {
  const auto frusta = DrawFrusta(MakeMap(), MakeCamera(), MakeHeader());
  ASSERT_EQ(frusta.markers.size(), 2U);
  EXPECT_EQ(frusta.markers[0].points.size(), 2U * 16U);
  ASSERT_EQ(frusta.markers[1].points.size(), 16U);
  EXPECT_NE(frusta.markers[0].color, frusta.markers[1].color);
  EXPECT_EQ(frusta.markers[1].points[0].x, 6.0);                 // The centre of camera 3.
  EXPECT_NEAR(frusta.markers[1].points[1].z, 0.4 * 2.0, 1e-12);  // A corner, 0.4 spacings ahead.
  EXPECT_NEAR(frusta.markers[1].points[1].x, 6.0 - 0.8 * 0.8, 1e-12);
}

TEST(DrawFrusta, DeletesWhatAnEmptyMapDoesNotHave) {
  for (const auto& marker : DrawFrusta(MapReplica(), MakeCamera(), MakeHeader()).markers) {
    EXPECT_EQ(marker.action, visualization_msgs::Marker::DELETE);
  }
}

// Whether a point lies in the pyramid that `overview` sees when it looks at `focus`.
bool IsInView(const Eigen::Vector3d& point,
              const Eigen::Vector3d& focus,
              const Overview& overview) {
  const Eigen::Vector3d towards_eye(std::cos(overview.pitch_rad) * std::cos(overview.yaw_rad),
                                    std::cos(overview.pitch_rad) * std::sin(overview.yaw_rad),
                                    std::sin(overview.pitch_rad));
  const Eigen::Vector3d ray = point - (focus + overview.distance * towards_eye);
  const Eigen::Vector3d right = Eigen::Vector3d::UnitZ().cross(towards_eye).normalized();
  const double reach = -ray.dot(towards_eye) * std::tan(overview.half_angle_rad) + 1e-9;
  return std::abs(ray.dot(right)) <= reach && std::abs(ray.dot(towards_eye.cross(right))) <= reach;
}

TEST(FindFocus, HasAllCamerasAndPointsInViewWhateverTheDirectionAndDistance) {
  const MapReplica map = MakeMap();
  for (const double yaw_rad : {0.0, 1.5, 4.4}) {
    for (const double distance : {0.1, 50.0}) {
      const Overview overview{yaw_rad, 0.4, distance, 0.3};
      const auto focus = FindFocus(map, /*min_views=*/2, overview);
      ASSERT_TRUE(focus);
      for (const auto& [id, landmark] : map.landmarks()) {
        EXPECT_TRUE(IsInView(landmark.state.position_in_map, *focus, overview)) << yaw_rad;
      }
      for (const auto& [photo, view] : map.views()) {
        EXPECT_TRUE(IsInView(view.cam_from_map.TargetOriginInSource(), *focus, overview));
      }
    }
  }
}

TEST(FindFocus, IsNowhereWithoutPoints) {
  EXPECT_EQ(FindFocus(MapReplica(), /*min_views=*/2, {0.0, 0.0, 1.0, 0.3}), std::nullopt);
}

TEST(DrawPath, RunsThroughTheCentresInOrder) {
  const nav_msgs::Path path = DrawPath(MakeMap(), MakeHeader());
  ASSERT_EQ(path.poses.size(), 3U);
  EXPECT_EQ(path.poses[0].pose.position.x, 2.0);
  EXPECT_EQ(path.poses[2].pose.position.x, 6.0);
}

TEST(DrawAnnotatedPhoto, PutsPointsWhereTheyAreUnderTheBanner) {
  const cv::Mat photo(1200, 1600, CV_8UC3, cv::Scalar(128, 128, 128));
  PhotoVerdict verdict;
  verdict.status = VerdictStatus::kAccepted;
  verdict.inlier_pixels = {{400.5F, 300.5F}};
  verdict.outlier_pixels = {{1200.5F, 900.5F}};
  const cv::Mat picture = DrawAnnotatedPhoto(Encode(photo), verdict, {}, 1600, 1200, 800);
  ASSERT_EQ(picture.cols, 800);
  const int banner = picture.rows - 600;
  ASSERT_GT(banner, 50);
  const cv::Vec3b inlier = picture.at<cv::Vec3b>(banner + 150, 200);
  const cv::Vec3b outlier = picture.at<cv::Vec3b>(banner + 450, 600);
  EXPECT_GT(inlier[1], inlier[2] + 100);    // Green.
  EXPECT_GT(outlier[2], outlier[1] + 100);  // Red.
}

TEST(DrawAnnotatedPhoto, ShowsTheVerdictOfWhatIsNoPhoto) {
  PhotoVerdict verdict;
  verdict.status = VerdictStatus::kRefused;
  verdict.reason = RefusalReason::kUndecodable;
  verdict.name = "broken.jpg";
  for (const std::string text : {"", "no photo"}) {
    const cv::Mat picture =
        DrawAnnotatedPhoto({text.begin(), text.end()}, verdict, {}, 1600, 1200, 800);
    EXPECT_EQ(picture.cols, 800);
    EXPECT_GT(picture.rows, 600);
  }
}

TEST(DrawAnnotatedPhoto, NeverEnlarges) {
  EXPECT_EQ(DrawAnnotatedPhoto({}, PhotoVerdict(), {}, 640, 480, 1280).cols, 640);
}

MarkerDetection MakeMarker(int id, const Eigen::Vector2d& center_px) {
  MarkerDetection marker;
  marker.id = id;
  marker.center_px = marker.ellipse.center_px = center_px;
  marker.ellipse.semi_major_px = 80.0;
  marker.ellipse.semi_minor_px = 40.0;
  return marker;
}

TEST(DrawAnnotatedMarkers, OutlinesMarkersWhereTheyAreAndThoseThatAreThereTwiceInYellow) {
  MarkerSearch search;
  search.gray = cv::Mat(1200, 1600, CV_8U, cv::Scalar(128));
  search.detections = {MakeMarker(3, {400.5, 300.5}),
                       MakeMarker(9, {1200.5, 300.5}),
                       MakeMarker(9, {1200.5, 900.5})};
  const cv::Mat picture = DrawAnnotatedMarkers(search, "a.jpg", 800);
  ASSERT_EQ(picture.cols, 800);
  const int banner = picture.rows - 600;
  ASSERT_GT(banner, 30);
  const cv::Vec3b once = picture.at<cv::Vec3b>(banner + 150, 200 - 40);
  EXPECT_GT(once[1], once[2] + 100);  // Green.
  const cv::Vec3b twice = picture.at<cv::Vec3b>(banner + 450 - 20, 600);
  EXPECT_GT(twice[2], twice[0] + 100);  // Yellow.
  EXPECT_EQ(picture.at<cv::Vec3b>(banner + 300, 400), cv::Vec3b(128, 128, 128));
}

TEST(DrawAnnotatedMarkers, TellsWhyAPhotoWasNotSearched) {
  MarkerSearch search;
  search.problem = "the file is empty";
  const cv::Mat picture = DrawAnnotatedMarkers(search, "a.jpg", 800);
  EXPECT_EQ(picture.cols, 800);
  const cv::Vec3b bar = picture.at<cv::Vec3b>(2, 2);
  EXPECT_GT(bar[2], bar[1] + 100);  // Red.
}

TEST(DrawAnnotatedMarkers, TakesEverythingThatAMessageMayHold) {
  MarkerSearch search;
  search.gray = cv::Mat(1, 1, CV_8U, cv::Scalar(0));
  for (int id = 0; id < 106; ++id) search.detections.push_back(MakeMarker(id, {1e7, -1e7}));
  EXPECT_EQ(DrawAnnotatedMarkers(search, "", 800).cols, 1);
}

TEST(WrapText, BreaksAtBlanksAndKeepsEveryWord) {
  EXPECT_THAT(WrapText("fly closer to the wall", 10), ElementsAre("fly closer", "to the", "wall"));
  EXPECT_THAT(WrapText("", 10), IsEmpty());
  EXPECT_THAT(WrapText("abcdefghijkl", 5), ElementsAre("abcde", "fghij", "kl"));
}

TEST(Latency, QuantilesAreOfTheNearestRank) {
  Latency latency;
  EXPECT_TRUE(latency.IsEmpty());
  for (int i = 20; i >= 1; --i) latency.Add(i);
  EXPECT_EQ(latency.Last_s(), 1.0);
  EXPECT_EQ(latency.Quantile_s(0.5), 10.0);
  EXPECT_EQ(latency.Quantile_s(0.95), 19.0);
  EXPECT_EQ(latency.Quantile_s(0.0), 1.0);
  EXPECT_EQ(latency.Quantile_s(1.0), 20.0);
}

}  // namespace
}  // namespace plumb::ros_adapter

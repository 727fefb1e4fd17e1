// SPDX-FileCopyrightText: 2026 The Plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "plumbline/georeference/geo_frame.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <stdexcept>

#include "test/support/random.h"

namespace plumb {
namespace {

using Eigen::Vector3d;

// Graz: on UTM 33 some 33 km east of the central meridian, on Austria's grid some 68 km west of it.
const Vector3d kGrazUtm(532600.0, 5212300.0, 361.0);
const Vector3d kGrazMgi(-68112.0, 212345.0, 361.0);

TEST(GeoFrame, ALocalSurveyIsItsOwnFrame) {
  const GeoFrame frame(kLocalCrs, HeightReference::kLocal, Vector3d(100, 200, 300));
  EXPECT_TRUE(frame.is_local());
  EXPECT_EQ(frame.ToEnu({101, 202, 303}), Vector3d(1, 2, 3));
  EXPECT_EQ(frame.ToCrs({1, 2, 3}), Vector3d(101, 202, 303));
  EXPECT_FALSE(frame.EarthFromEnu());
  EXPECT_FALSE(frame.ToWgs84({1, 2, 3}));
  EXPECT_FALSE(frame.FromWgs84({47, 15, 400.0}));
}

TEST(GeoFrame, ComesBackFromEveryCrs) {
  test::Random random(1);
  for (const auto& [crs, origin] : {std::pair<const char*, Vector3d>{"EPSG:32633", kGrazUtm},
                                    {"EPSG:31256", kGrazMgi},
                                    {"EPSG:2056", {2600000, 1200000, 550}},
                                    {"EPSG:4979", {15.44, 47.07, 400}}}) {
    const GeoFrame frame(crs, HeightReference::kEllipsoidal, origin);
    EXPECT_LT(frame.ToEnu(origin).norm(), 1e-6) << crs;
    for (int i = 0; i < 20; ++i) {
      const Vector3d point_in_enu = random.InBox(100.0);
      const Vector3d again = frame.ToEnu(frame.ToCrs(point_in_enu));
      EXPECT_LT((again - point_in_enu).norm(), 1e-6) << crs;  // [m]
    }
  }
}

TEST(GeoFrame, UndoesTheStretchOfTheProjection) {
  // On the central meridian UTM shortens by 0.9996, and does not turn; heights stay as they are.
  const Vector3d origin(500000.0, 5212300.0, 0.0);
  const GeoFrame frame("EPSG:32633", HeightReference::kEllipsoidal, origin);
  const Vector3d moved = frame.ToEnu(origin + Vector3d(100, 0, 0));
  EXPECT_NEAR(moved.x(), 100.0 / 0.9996, 1e-4);
  EXPECT_NEAR(moved.y(), 0.0, 1e-3);  // The parallel is curved.
  EXPECT_NEAR(frame.ToEnu(origin + Vector3d(0, 100, 0)).y(), 100.0 / 0.9996, 1e-4);
  EXPECT_NEAR(frame.ToEnu(origin + Vector3d(0, 0, 30)).z(), 30.0, 1e-6);
  // East of it north is no longer the grid's: convergence = (lon - 15 deg) sin(lat).
  const GeoFrame east("EPSG:32633", HeightReference::kEllipsoidal, kGrazUtm);
  const Vector3d north = east.ToEnu(kGrazUtm + Vector3d(0, 100, 0));
  const double lon_off_rad = (kGrazUtm.x() - 500000.0) / (6.38e6 * std::cos(47.06 * M_PI / 180.0));
  EXPECT_NEAR(
      std::atan2(-north.x(), north.y()), -lon_off_rad * std::sin(47.06 * M_PI / 180.0), 2e-5);
}

TEST(GeoFrame, PlacesItsOriginOnEarth) {
  const GeoFrame frame("EPSG:4979", HeightReference::kEllipsoidal, {15.0, 47.0, 400.0});
  const auto earth_from_enu = frame.EarthFromEnu();
  ASSERT_TRUE(earth_from_enu);
  // WGS 84's closed form.
  const double lat = 47.0 * M_PI / 180.0;
  const double lon = 15.0 * M_PI / 180.0;
  const double e2 = 6.69437999014e-3;
  const double normal = 6378137.0 / std::sqrt(1.0 - e2 * std::sin(lat) * std::sin(lat));
  const Vector3d expected((normal + 400.0) * std::cos(lat) * std::cos(lon),
                          (normal + 400.0) * std::cos(lat) * std::sin(lon),
                          (normal * (1.0 - e2) + 400.0) * std::sin(lat));
  EXPECT_LT((*earth_from_enu * Vector3d(0, 0, 0) - expected).norm(), 1e-4);
  const auto above = frame.ToWgs84({0, 0, 10});
  ASSERT_TRUE(above);
  EXPECT_NEAR(above->lat_deg, 47.0, 1e-10);
  EXPECT_NEAR(*above->alt_m, 410.0, 1e-6);
  const Vector3d up = *earth_from_enu * Vector3d(0, 0, 1) - *earth_from_enu * Vector3d(0, 0, 0);
  EXPECT_NEAR(
      up.dot(expected.normalized()), 1.0, 1e-5);  // The ellipsoid's normal, not the sphere's.
  const Vector3d east = *earth_from_enu * Vector3d(1, 0, 0) - *earth_from_enu * Vector3d(0, 0, 0);
  EXPECT_NEAR(east.z(), 0.0, 1e-9);
}

TEST(GeoFrame, RaisesOrthometricHeightsByTheGeoid) {
  const GeoFrame above_sea("EPSG:32633", HeightReference::kOrthometric, kGrazUtm);
  const GeoFrame above_ellipsoid("EPSG:32633", HeightReference::kEllipsoidal, kGrazUtm);
  const auto by_sea = above_sea.ToWgs84({0, 0, 0});
  const auto by_ellipsoid = above_ellipsoid.ToWgs84({0, 0, 0});
  ASSERT_TRUE(by_sea) << "libproj brings proj-data, which has egm96_15.gtx";
  ASSERT_TRUE(by_ellipsoid);
  // The geoid lies some 47 m above the ellipsoid at Graz.
  EXPECT_NEAR(*by_sea->alt_m - *by_ellipsoid->alt_m, 47.0, 2.0);
  const auto back = above_sea.FromWgs84(*by_sea);
  ASSERT_TRUE(back);
  EXPECT_LT(back->norm(), 1e-4);
  EXPECT_FALSE(above_sea.FromWgs84({47.0, 15.0, std::nullopt}));
}

TEST(GeoFrame, ShiftsTheDatum) {
  // MGI and WGS 84 differ by some 80 m in Austria; a frame on MGI finds WGS 84's place.
  const GeoFrame mgi("EPSG:31256", HeightReference::kEllipsoidal, kGrazMgi);
  const auto place = mgi.ToWgs84({0, 0, 0});
  ASSERT_TRUE(place);
  const auto back = mgi.FromWgs84(*place);
  ASSERT_TRUE(back);
  EXPECT_LT(back->norm(), 1e-3);
  const GeoFrame wgs84(
      "EPSG:4979", HeightReference::kEllipsoidal, {place->lon_deg, place->lat_deg, *place->alt_m});
  // By PROJ's own data base, without the datum: EPSG:31256 read as if on WGS 84.
  const GeoFrame bessel("EPSG:4312", HeightReference::kEllipsoidal, {15.4374, 47.0475, 361.0});
  EXPECT_LT(wgs84.ToEnu(wgs84.origin_in_crs()).norm(), 1e-6);
  const auto shifted = bessel.ToWgs84({0, 0, 0});
  ASSERT_TRUE(shifted);
  const double off_m =
      std::hypot((shifted->lat_deg - 47.0475) * 111'200.0, (shifted->lon_deg - 15.4374) * 75'900.0);
  EXPECT_GT(off_m, 30.0);
  EXPECT_LT(off_m, 200.0);
}

TEST(GeoFrame, PutsItsOriginAtWholeNumbersNearTheSurvey) {
  Survey survey;
  survey.targets.push_back({1, "1", {3.0, 4.0, 5.0}, 0.001, false, 1});
  EXPECT_EQ(GeoFrame::Around(survey).origin_in_crs(), Vector3d(0, 0, 0));
  survey.targets[0].point_in_crs = {123456.78, 4.0, 5.0};
  EXPECT_EQ(GeoFrame::Around(survey).origin_in_crs(), Vector3d(123460, 0, 10));
  survey.crs = "EPSG:31256";
  survey.heights = HeightReference::kOrthometric;
  survey.targets[0].point_in_crs = kGrazMgi;
  const GeoFrame frame = GeoFrame::Around(survey);
  EXPECT_EQ(frame.origin_in_crs(), Vector3d(-68110, 212350, 360));
  EXPECT_LT(frame.ToEnu(kGrazMgi).norm(), 10.0);
}

TEST(GeoFrame, RefusesWhatProjCannotPlace) {
  EXPECT_THROW(GeoFrame("EPSG:99999", HeightReference::kEllipsoidal, {0, 0, 0}),
               std::runtime_error);
  EXPECT_THROW(GeoFrame("EPSG:32633", HeightReference::kEllipsoidal, {1e30, 0, 0}),
               std::runtime_error);
}

}  // namespace
}  // namespace plumb

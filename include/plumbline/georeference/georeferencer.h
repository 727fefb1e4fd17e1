// SPDX-FileCopyrightText: 2026 The Plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <unordered_map>
#include <vector>

#include "plumbline/camera/camera.h"
#include "plumbline/common/ids.h"
#include "plumbline/georeference/georeference.h"
#include "plumbline/georeference/georeferencer_options.h"
#include "plumbline/georeference/robust_similarity.h"
#include "plumbline/georeference/survey.h"
#include "plumbline/georeference/target_triangulation.h"
#include "plumbline/image/photo_analysis.h"
#include "plumbline/map/map_delta.h"
#include "plumbline/marker/marker_detector.h"
#include "plumbline/sfm/bundle_constraints.h"

namespace plumb {

struct GpsPhoto;

// Puts the map on the earth while it grows. It hears, in any order, the markers found in each
// photo, the position each was taken at, and the map's deltas; only located photos count. Update
// then triangulates the targets whose photos were added or moved, and computes the rest anew: some
// ten milliseconds of one core at 500 photos (georeference_benchmark). Not thread-safe.
class Georeferencer {
 public:
  // `camera` is as the session holds it; a refined lens comes by the deltas. Throws
  // std::invalid_argument if options.Problems() is not empty.
  Georeferencer(const GeoreferencerOptions& options, const Camera& camera);

  // Takes the place of the survey before, if any. Throws like GeoFrame.
  void SetSurvey(Survey survey);
  void ClearSurvey();

  // What was found in a photo; a second call for it replaces the first.
  void SetMarkers(PhotoId photo, std::vector<MarkerDetection> markers);

  // Where the photo was taken, WGS 84 with ellipsoidal height. Without a height it is not used.
  void SetPosition(PhotoId photo, const GeodeticPosition& position);

  // Why `survey`, whose frame this is, cannot be of these photos: it lies farther from their GPS
  // than max_gps_distance_m. Update says the same of the survey in use and does not use it. Nothing
  // if it may be, or no photo has a position yet.
  std::optional<Finding> FindElsewhere(const Survey& survey, const GeoFrame& frame) const;

  // False, and nothing changed, if the delta is no snapshot and not the next in number: ask for a
  // snapshot.
  bool Apply(const MapDelta& delta);

  // What is known now.
  const Georeference& Update();

  // The located photos' sightings that Update has used, for ToGcpList.
  std::vector<PointedTarget> Sightings() const;

  // The same for the mapper's bundle, by the last Update: every target is a track; good control
  // points carry their survey, brought into the map. Check points and wrong ones do not. Positions
  // by GPS come, if the options say so, as the similarity that fits them best brings them into the
  // map: what all of them are off by, or the place and turn that targets give, is not disputed.
  BundleConstraints Constraints() const;

 private:
  struct Target {
    std::vector<TargetSighting> sightings;
    std::vector<double> sizes_px;  // Of each: the marker's diameter; 0 if it was pointed at.
    std::optional<TriangulatedTarget> triangulated;
  };

  void MarkChanged(PhotoId photo);
  void MarkAllChanged();
  Target CollectTarget(int id) const;
  void TriangulateChanged();

  TargetReport ReportOf(int id, const SurveyTarget* surveyed) const;
  std::vector<TargetReport> ReportTargets() const;
  void AddTargetFindings(Georeference* georeference) const;
  std::optional<double> DiameterInMap() const;
  std::vector<GpsPhoto> GpsPhotos() const;
  std::vector<Eigen::Vector3d> ModelSample(const Similarity3& enu_from_map) const;

  void AddCenters(BundleConstraints* constraints) const;

  void UseTargets(const RobustSimilarity& similarity, Georeference* georeference);
  void UseGps(const RobustSimilarity& similarity,
              const GeoFrame& frame,
              Georeference* georeference) const;

  GeoreferencerOptions options_;
  Camera camera_;
  std::optional<Survey> survey_;
  std::optional<GeoFrame> frame_;      // Of the survey.
  std::optional<GeoFrame> gps_frame_;  // Once there is a photo with a position; stays.
  std::map<PhotoId, std::vector<MarkerDetection>> markers_;
  std::map<PhotoId, GeodeticPosition> positions_;

  // Of the map.
  std::uint32_t sequence_ = 0;
  std::map<PhotoId, ViewState> views_;
  std::unordered_map<LandmarkId, Eigen::Vector3d> landmarks_;

  std::map<int, Target> targets_;  // What was seen in located photos, by id.
  std::set<int> changed_ids_;      // Of them and of new ones, since the last Update.
  Georeference georeference_;
  std::optional<Similarity3> gps_enu_from_map_;  // By GPS alone, in the frame below.
  std::optional<GeoFrame> used_gps_frame_;
};

}  // namespace plumb

// SPDX-FileCopyrightText: 2026 The Plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "plumbline/georeference/georeferencer.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "common/median.h"
#include "georeference/finding_text.h"
#include "georeference/gps_alignment.h"
#include "georeference/plausibility.h"
#include "georeference/survey_place.h"
#include "georeference/target_adjustment.h"
#include "georeference/target_layout.h"

namespace plumb {
namespace {

using Severity = Finding::Severity;

// A hand is no better than this [px].
constexpr double kPointingSigma_px = 1.0;

// One landmark in so many is kept, by its id: enough to tell how far the model reaches, and Update
// goes through all that are.
constexpr std::uint32_t kLandmarkStride = 8;

Similarity3 operator*(const Rigid3& c_from_b, const Similarity3& b_from_a) {
  return {b_from_a.scale,
          c_from_b.rotation * b_from_a.rotation,
          c_from_b.rotation * b_from_a.translation + c_from_b.translation};
}

}  // namespace

Georeferencer::Georeferencer(const GeoreferencerOptions& options, const Camera& camera)
    : options_(options), camera_(camera) {
  ThrowIfProblems("georeferencer", options.Problems());
}

void Georeferencer::SetSurvey(Survey survey) {
  frame_ = GeoFrame::Around(survey);
  survey_ = std::move(survey);
  MarkAllChanged();
}

void Georeferencer::ClearSurvey() {
  survey_.reset();
  frame_.reset();
  MarkAllChanged();
}

void Georeferencer::SetMarkers(PhotoId photo, std::vector<MarkerDetection> markers) {
  MarkChanged(photo);
  markers_[photo] = std::move(markers);
  MarkChanged(photo);
}

void Georeferencer::SetPosition(PhotoId photo, const GeodeticPosition& position) {
  positions_[photo] = position;
}

bool Georeferencer::Apply(const MapDelta& delta) {
  if (!delta.is_snapshot && delta.sequence != sequence_ + 1) return false;
  if (delta.is_snapshot) {
    views_.clear();
    landmarks_.clear();
    MarkAllChanged();
  }
  sequence_ = delta.sequence;
  // An impossible lens is left out.
  if (auto camera = delta.lens ? camera_.WithLens(*delta.lens) : std::nullopt) {
    camera_ = *std::move(camera);
    MarkAllChanged();
  }
  for (const LandmarkId id : delta.landmarks_removed) landmarks_.erase(id);
  for (const PhotoId photo : delta.views_removed) {
    MarkChanged(photo);
    views_.erase(photo);
  }
  for (const ViewState& view : delta.views_set) {
    views_[view.photo] = view;
    MarkChanged(view.photo);
  }
  for (const LandmarkState& landmark : delta.landmarks_set) {
    if (landmark.id.value % kLandmarkStride == 0) {
      landmarks_[landmark.id] = landmark.position_in_map;
    }
  }
  return true;
}

void Georeferencer::MarkChanged(PhotoId photo) {
  const auto markers = markers_.find(photo);
  if (markers != markers_.end()) {
    for (const MarkerDetection& marker : markers->second) changed_ids_.insert(marker.id);
  }
  const auto view = views_.find(photo);
  if (view == views_.end() || !survey_) return;
  for (const PointedTarget& pointed : survey_->pointed) {
    if (pointed.photo == view->second.name) changed_ids_.insert(pointed.id);
  }
}

void Georeferencer::MarkAllChanged() {
  for (const auto& [id, target] : targets_) changed_ids_.insert(id);
  for (const auto& [photo, markers] : markers_) {
    for (const MarkerDetection& marker : markers) changed_ids_.insert(marker.id);
  }
  if (!survey_) return;
  for (const PointedTarget& pointed : survey_->pointed) changed_ids_.insert(pointed.id);
}

// What a detector found in a photo goes before what a hand pointed at there.
Georeferencer::Target Georeferencer::CollectTarget(int id) const {
  Target target;
  std::set<PhotoId> detected;
  for (const auto& [photo, markers] : markers_) {
    const auto view = views_.find(photo);
    if (view == views_.end()) continue;
    for (const MarkerDetection& marker : markers) {
      if (marker.id != id) continue;
      detected.insert(photo);
      target.sightings.push_back(
          {photo, view->second.cam_from_map, marker.center_px, marker.center_covariance_px2});
      target.sizes_px.push_back(2.0 * marker.ellipse.semi_major_px);
    }
  }
  if (!survey_) return target;
  for (const auto& [photo, view] : views_) {
    if (detected.count(photo) != 0) continue;
    for (const PointedTarget& pointed : survey_->pointed) {
      if (pointed.id != id || pointed.photo != view.name) continue;
      target.sightings.push_back(
          {photo,
           view.cam_from_map,
           pointed.pixel,
           kPointingSigma_px * kPointingSigma_px * Eigen::Matrix2d::Identity()});
      target.sizes_px.push_back(0.0);
    }
  }
  return target;
}

void Georeferencer::TriangulateChanged() {
  const TriangulationBounds bounds = {
      options_.max_error_px, options_.min_parallax_deg, options_.min_sigma_px};
  for (const int id : changed_ids_) {
    Target target = CollectTarget(id);
    if (target.sightings.empty()) {
      targets_.erase(id);
      continue;
    }
    target.triangulated = TriangulateTarget(bounds, camera_, target.sightings);
    targets_[id] = std::move(target);
  }
  changed_ids_.clear();
}

TargetReport Georeferencer::ReportOf(int id, const SurveyTarget* surveyed) const {
  TargetReport report;
  report.id = id;
  report.name = surveyed != nullptr ? surveyed->name : std::to_string(id);
  report.is_check = surveyed != nullptr && surveyed->is_check;
  const auto found = targets_.find(id);
  if (found == targets_.end()) return report;
  const Target& target = found->second;
  std::set<PhotoId> photos;
  for (const TargetSighting& sighting : target.sightings) photos.insert(sighting.photo);
  report.num_photos = static_cast<int>(photos.size());
  if (!target.triangulated) return report;
  report.num_used = static_cast<int>(target.triangulated->used.size());
  report.rms_error_px = target.triangulated->rms_error_px;
  report.point_in_map = target.triangulated->point_in_map;
  report.covariance_in_map = target.triangulated->covariance;
  if (target.triangulated->second_point_in_map) {
    report.state = TargetState::kDouble;
  } else {
    report.state = surveyed != nullptr ? TargetState::kWaiting : TargetState::kUnsurveyed;
  }
  return report;
}

std::vector<TargetReport> Georeferencer::ReportTargets() const {
  std::map<int, const SurveyTarget*> surveyed;
  if (survey_) {
    for (const SurveyTarget& target : survey_->targets) surveyed[target.id] = &target;
  }
  for (const auto& [id, target] : targets_) surveyed.insert({id, nullptr});
  std::vector<TargetReport> reports;
  for (const auto& [id, target] : surveyed) reports.push_back(ReportOf(id, target));
  return reports;
}

// As a circle far away, whose major axis is the diameter.
std::optional<double> Georeferencer::DiameterInMap() const {
  std::vector<double> diameters;
  for (const auto& [id, target] : targets_) {
    if (!target.triangulated) continue;
    for (const int idx : target.triangulated->used) {
      const auto i = static_cast<std::size_t>(idx);
      if (!(target.sizes_px[i] > 0.0)) continue;
      const Eigen::Vector3d in_cam =
          target.sightings[i].cam_from_map * target.triangulated->point_in_map;
      diameters.push_back(target.sizes_px[i] * in_cam.z() / camera_.MeanFocalLength());
    }
  }
  if (diameters.empty()) return std::nullopt;
  return MedianOf(diameters);
}

void Georeferencer::AddTargetFindings(Georeference* georeference) const {
  std::string unsurveyed;
  for (const TargetReport& report : georeference->targets) {
    if (report.state == TargetState::kUnsurveyed) {
      unsurveyed += (unsurveyed.empty() ? "" : ", ") + report.name;
    }
    if (report.state != TargetState::kDouble) continue;
    AddFinding(Severity::kWarning,
               "double_marker",
               Text("marker ",
                    report.name,
                    " is seen in two places and left out: two markers have "
                    "this id; take one down, or print it with another"),
               &georeference->findings);
  }
  if (unsurveyed.empty() || !survey_) return;
  AddFinding(Severity::kNote,
             "unsurveyed_markers",
             Text(survey_->source,
                  ": has no point for the markers ",
                  unsurveyed,
                  ", which the photos show; add them, if they were measured"),
             &georeference->findings);
}

std::vector<GpsPhoto> Georeferencer::GpsPhotos() const {
  std::vector<GpsPhoto> photos;
  for (const auto& [photo, view] : views_) {
    const auto position = positions_.find(photo);
    if (position == positions_.end() || !position->second.alt_m) continue;
    photos.push_back({view.cam_from_map.TargetOriginInSource(), position->second});
  }
  return photos;
}

std::optional<Finding> Georeferencer::FindElsewhere(const Survey& survey,
                                                    const GeoFrame& frame) const {
  std::vector<GeodeticPosition> positions;
  positions.reserve(positions_.size());
  for (const auto& [photo, position] : positions_) positions.push_back(position);
  return plumb::FindElsewhere(options_.max_gps_distance_m, survey, frame, positions);
}

// About so many as CheckLayout needs.
std::vector<Eigen::Vector3d> Georeferencer::ModelSample(const Similarity3& enu_from_map) const {
  constexpr std::size_t kMaxPoints = 5000;
  const std::size_t step = 1 + landmarks_.size() / kMaxPoints;
  std::vector<Eigen::Vector3d> sample;
  std::size_t count = 0;
  for (const auto& [id, position] : landmarks_) {
    if (count++ % step == 0) sample.push_back(enu_from_map * position);
  }
  return sample;
}

void Georeferencer::UseTargets(const RobustSimilarity& similarity, Georeference* georeference) {
  std::vector<Eigen::Vector3d> control;
  for (const TargetReport& report : georeference->targets) {
    if (report.state == TargetState::kGood && !report.is_check) {
      control.push_back(similarity.target_from_source * report.point_in_map);
    }
  }
  for (Finding& finding :
       CheckLayout(options_.min_coverage, control, ModelSample(similarity.target_from_source))) {
    georeference->findings.push_back(std::move(finding));
  }
  if (frame_->heights() == HeightReference::kUnstated) {
    AddFinding(Severity::kNote,
               "heights_unstated",
               Text(survey_->source,
                    ": does not say what its heights count from, they are taken as "
                    "orthometric; add a line \"# heights: orthometric\" or \"# heights: "
                    "ellipsoidal\""),
               &georeference->findings);
  }
  georeference->source = GeoreferenceSource::kTargets;
  georeference->frame = frame_;
  georeference->enu_from_map = similarity.target_from_source;
}

void Georeferencer::UseGps(const RobustSimilarity& similarity,
                           const GeoFrame& frame,
                           Georeference* georeference) const {
  AddFinding(
      Severity::kWarning,
      "gps_only",
      "the model is placed by the photos' GPS alone: metres off, and its scale by per cents; "
      "survey targets for more",
      &georeference->findings);
  georeference->source = GeoreferenceSource::kGps;
  georeference->frame = frame;
  georeference->enu_from_map = similarity.target_from_source;
}

const Georeference& Georeferencer::Update() {
  TriangulateChanged();
  Georeference result;
  result.map_sequence = sequence_;
  result.targets = ReportTargets();
  AddTargetFindings(&result);
  std::optional<RobustSimilarity> by_targets;
  if (survey_) by_targets = AdjustToTargets(options_, *survey_, *frame_, &result);
  const std::optional<double> diameter = DiameterInMap();
  if (by_targets && diameter) {
    result.marker_diameter_m = by_targets->target_from_source.scale * *diameter;
  }

  const std::vector<GpsPhoto> photos = GpsPhotos();
  if (!photos.empty() && !gps_frame_) gps_frame_ = FrameAround(photos[0]);
  // In one frame with the survey, if that is on earth and of this place.
  const std::optional<Finding> elsewhere =
      survey_ ? FindElsewhere(*survey_, *frame_) : std::nullopt;
  if (elsewhere) result.findings.push_back(*elsewhere);
  const bool is_survey_on_earth = frame_ && !frame_->is_local() && !elsewhere;
  const GeoFrame* const gps_frame = is_survey_on_earth ? &*frame_
                                    : gps_frame_       ? &*gps_frame_
                                                       : nullptr;
  RobustSimilarity by_gps;
  if (gps_frame != nullptr) by_gps = AlignToGps(options_, *gps_frame, photos);
  gps_enu_from_map_.reset();
  used_gps_frame_.reset();
  if (by_gps.status == RobustSimilarity::Status::kOk) {
    gps_enu_from_map_ = by_gps.target_from_source;
    used_gps_frame_ = *gps_frame;
  }
  if (!photos.empty()) {
    CompareWithGps(
        by_targets ? &*by_targets : nullptr, by_gps, frame_ ? &*frame_ : nullptr, photos, &result);
  }
  if (by_targets) {
    CheckShape(options_, *survey_, by_targets->target_from_source, &result);
    if (!elsewhere) CheckPlace(options_, frame_->heights(), &result);
  }
  const bool is_refused =
      std::any_of(result.findings.begin(), result.findings.end(), [](const Finding& finding) {
        return finding.severity == Severity::kError;
      });
  if (by_targets && !is_refused) {
    UseTargets(*by_targets, &result);
  } else if (by_gps.status == RobustSimilarity::Status::kOk) {
    UseGps(by_gps, *gps_frame, &result);
  }
  if (result.frame) {
    const std::optional<Rigid3> earth_from_enu = result.frame->EarthFromEnu();
    if (earth_from_enu) result.earth_from_map = *earth_from_enu * result.enu_from_map;
  }
  std::stable_sort(result.findings.begin(),
                   result.findings.end(),
                   [](const auto& a, const auto& b) { return a.severity > b.severity; });
  georeference_ = std::move(result);
  return georeference_;
}

std::vector<PointedTarget> Georeferencer::Sightings() const {
  std::vector<PointedTarget> sightings;
  for (const auto& [id, target] : targets_) {
    if (!target.triangulated || target.triangulated->second_point_in_map) continue;
    for (const int idx : target.triangulated->used) {
      const TargetSighting& sighting = target.sightings[static_cast<std::size_t>(idx)];
      sightings.push_back({id, views_.at(sighting.photo).name, sighting.pixel});
    }
  }
  return sightings;
}

}  // namespace plumb

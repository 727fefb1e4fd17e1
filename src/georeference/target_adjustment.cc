// SPDX-FileCopyrightText: 2026 The Plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "georeference/target_adjustment.h"

#include <algorithm>
#include <cmath>
#include <map>

#include "georeference/finding_text.h"
#include "georeference/mirror_check.h"
#include "georeference/similarity_fit.h"

namespace plumb {
namespace {

using Severity = Finding::Severity;

// Of a target against the survey, as in the search of EstimateRobustSimilarity.
constexpr double kWrongBound = 4.0;

// A target that is surveyed and seen.
struct Pairing {
  TargetReport* report;
  PointPair pair;
};

std::vector<Pairing> PairUp(const Survey& survey,
                            const GeoFrame& frame,
                            std::vector<TargetReport>* reports) {
  std::map<int, const SurveyTarget*> surveyed;
  for (const SurveyTarget& target : survey.targets) surveyed[target.id] = &target;
  std::vector<Pairing> pairings;
  for (TargetReport& report : *reports) {
    if (report.state != TargetState::kWaiting) continue;
    const SurveyTarget& target = *surveyed.at(report.id);
    PointPair pair;
    pair.in_source = report.point_in_map;
    pair.source_covariance = report.covariance_in_map;
    pair.in_target = frame.ToEnu(target.point_in_crs);
    pair.target_covariance = target.sigma_m * target.sigma_m * Eigen::Matrix3d::Identity();
    pairings.push_back({&report, pair});
  }
  return pairings;
}

std::vector<PointPair> ControlPairs(const std::vector<Pairing>& pairings) {
  std::vector<PointPair> pairs;
  for (const Pairing& pairing : pairings) {
    if (!pairing.report->is_check) pairs.push_back(pairing.pair);
  }
  return pairs;
}

void AddMirrorFinding(const Survey& survey,
                      const MirrorImage& image,
                      bool is_fit,
                      std::vector<Finding>* findings) {
  const std::string otherwise = is_fit ? Text(", as they stand to ", image.rms_m, " m")
                                       : std::string(", as they stand not at all");
  AddFinding(Severity::kError,
             "swapped_axes",
             Text(survey.source,
                  ": ",
                  image.num_pairs,
                  " control points fit as a mirror image to ",
                  image.mirrored_rms_m,
                  " m",
                  otherwise,
                  ": two axes are exchanged, or one counts the wrong way; correct the columns: x_m "
                  "is east (right), y_m north (away), z_m up"),
             findings);
}

void ExplainFailure(const RobustSimilarityOptions& options,
                    const Survey& survey,
                    const std::vector<PointPair>& control,
                    const RobustSimilarity& similarity,
                    std::vector<Finding>* findings) {
  const auto num_control =
      std::count_if(survey.targets.begin(), survey.targets.end(), [](const SurveyTarget& target) {
        return !target.is_check;
      });
  const std::string seen = Text(control.size(), " of ", num_control, " control points");
  switch (similarity.status) {
    case RobustSimilarity::Status::kTooFewPairs:
      return AddFinding(
          Severity::kError,
          "too_few_targets",
          Text(survey.source,
               ": ",
               seen,
               " are seen in two located photos or more; three that "
               "are not in a line are needed: ",
               num_control < 3 ? "survey more markers, or give check points the role control"
                               : "take photos of the others from several sides"),
          findings);
    case RobustSimilarity::Status::kCollinear:
      return AddFinding(Severity::kError,
                        "collinear_targets",
                        Text(survey.source,
                             ": the ",
                             seen,
                             " that are seen lie on a line, so that "
                             "the model could turn about it; survey a marker beside the line"),
                        findings);
    case RobustSimilarity::Status::kNoAgreement:
      break;
    case RobustSimilarity::Status::kOk:
      return;
  }
  const std::optional<MirrorImage> image = FindMirrorImage(options, control, similarity);
  if (image) return AddMirrorFinding(survey, *image, /*is_fit=*/false, findings);
  AddFinding(Severity::kError,
             "no_agreement",
             Text(survey.source,
                  ": of the ",
                  seen,
                  " no three, or not more than half, have the "
                  "same shape in the survey and in the photos; check ids, columns and unit, or "
                  "survey more markers"),
             findings);
}

// Which of the wrong targets would fit with another's survey.
const Pairing* ExchangedWith(const std::vector<Pairing>& pairings,
                             const Similarity3& enu_from_map,
                             double bend,
                             const Pairing& wrong) {
  const auto fits = [&](const Pairing& seen, const Pairing& surveyed) {
    PointPair pair = seen.pair;
    pair.in_target = surveyed.pair.in_target;
    return NormalizedError(pair, enu_from_map, ResidualCovariance(pair, enu_from_map, bend)) <
           kWrongBound;
  };
  for (const Pairing& other : pairings) {
    const bool is_candidate =
        other.report->state == TargetState::kWrong && other.report->id != wrong.report->id;
    if (is_candidate && fits(wrong, other) && fits(other, wrong)) return &other;
  }
  return nullptr;
}

void NameWrongTargets(const std::vector<Pairing>& pairings,
                      const Similarity3& enu_from_map,
                      double bend,
                      std::vector<Finding>* findings) {
  for (const Pairing& pairing : pairings) {
    const TargetReport& report = *pairing.report;
    if (report.state != TargetState::kWrong) continue;
    const Eigen::Vector3d& off = report.residual_m;
    const std::string where = Text(" is seen ",
                                   off.norm(),
                                   " m from where the survey has it (",
                                   off.x(),
                                   ", ",
                                   off.y(),
                                   ", ",
                                   off.z(),
                                   " m) and left out");
    const Pairing* other = ExchangedWith(pairings, enu_from_map, bend, pairing);
    if (other != nullptr) {
      AddFinding(Severity::kWarning,
                 "exchanged_targets",
                 Text("target ",
                      report.name,
                      where,
                      "; it fits with the coordinates of ",
                      other->report->name,
                      ": exchange the two ids in the survey"),
                 findings);
    } else {
      AddFinding(Severity::kWarning,
                 "wrong_target",
                 Text("target ",
                      report.name,
                      where,
                      ": it was moved, or its id or coordinates are wrong; measure it anew"),
                 findings);
    }
  }
}

ResidualSummary Summarise(std::vector<double> lengths_m) {
  ResidualSummary summary;
  if (lengths_m.empty()) return summary;
  std::sort(lengths_m.begin(), lengths_m.end());
  const std::size_t count = lengths_m.size();
  double sum = 0.0;
  double sum_of_squares = 0.0;
  for (const double length : lengths_m) {
    sum += length;
    sum_of_squares += length * length;
  }
  summary.count = static_cast<int>(count);
  summary.mean_mm = 1000.0 * sum / static_cast<double>(count);
  summary.median_mm = 500.0 * (lengths_m[count / 2] + lengths_m[(count - 1) / 2]);
  summary.max_mm = 1000.0 * lengths_m.back();
  summary.rms_mm = 1000.0 * std::sqrt(sum_of_squares / static_cast<double>(count));
  return summary;
}

ResidualSummary SummaryOf(const std::vector<Pairing>& pairings, bool of_check) {
  std::vector<double> lengths_m;
  for (const Pairing& pairing : pairings) {
    const TargetReport& report = *pairing.report;
    if (report.is_check == of_check && report.state == TargetState::kGood) {
      lengths_m.push_back(report.residual_m.norm());
    }
  }
  return Summarise(lengths_m);
}

void FillIn(const RobustSimilarity& similarity, double max_bend, std::vector<Pairing>* pairings) {
  std::size_t control_idx = 0;
  for (Pairing& pairing : *pairings) {
    TargetReport& report = *pairing.report;
    const Similarity3& enu_from_map = similarity.target_from_source;
    report.residual_m = enu_from_map * pairing.pair.in_source - pairing.pair.in_target;
    const Eigen::Matrix3d of_similarity = CovarianceAt(similarity, pairing.pair.in_source);
    bool is_good = false;
    if (report.is_check) {
      const Eigen::Matrix3d covariance =
          ResidualCovariance(pairing.pair, enu_from_map, max_bend) + of_similarity;
      is_good = NormalizedError(pairing.pair, enu_from_map, covariance) < kWrongBound;
    } else {
      is_good = similarity.is_good[control_idx++] != 0;
    }
    report.state = is_good ? TargetState::kGood : TargetState::kWrong;
    Eigen::Matrix3d expected = ResidualCovariance(pairing.pair, enu_from_map, 0.0);
    if (report.is_check || !is_good) expected += of_similarity;
    report.sigma_m = std::sqrt(expected.trace());
  }
}

double ExtentOf(const std::vector<Pairing>& pairings) {
  Eigen::AlignedBox3d box;
  for (const Pairing& pairing : pairings) {
    if (!pairing.report->is_check) box.extend(pairing.pair.in_target);
  }
  return box.isEmpty() ? 0.0 : box.diagonal().norm();
}

}  // namespace

std::optional<RobustSimilarity> AdjustToTargets(const GeoreferencerOptions& options,
                                                const Survey& survey,
                                                const GeoFrame& frame,
                                                Georeference* georeference) {
  std::vector<Pairing> pairings = PairUp(survey, frame, &georeference->targets);
  const std::vector<PointPair> control = ControlPairs(pairings);
  RobustSimilarityOptions robust;
  robust.max_bend_ratio = options.max_bend_ratio;
  const RobustSimilarity similarity = EstimateRobustSimilarity(robust, control);
  if (similarity.status != RobustSimilarity::Status::kOk) {
    ExplainFailure(robust, survey, control, similarity, &georeference->findings);
    return std::nullopt;
  }
  const std::optional<MirrorImage> image = FindMirrorImage(robust, control, similarity);
  if (image) AddMirrorFinding(survey, *image, /*is_fit=*/true, &georeference->findings);
  const double max_bend = options.max_bend_ratio * ExtentOf(pairings);
  FillIn(similarity, max_bend, &pairings);
  // Of a mirror image the targets that are off are not the wrong ones.
  if (!image) {
    NameWrongTargets(pairings, similarity.target_from_source, max_bend, &georeference->findings);
  }
  if (similarity.is_ambiguous && !image) {
    AddFinding(Severity::kWarning,
               "ambiguous_targets",
               Text(survey.source,
                    ": which control points are wrong is not certain: as many agree "
                    "on something else; survey more markers"),
               &georeference->findings);
  }
  georeference->control = SummaryOf(pairings, /*of_check=*/false);
  georeference->check = SummaryOf(pairings, /*of_check=*/true);
  georeference->bend_sigma_m = similarity.bend_sigma;
  return similarity;
}

}  // namespace plumb

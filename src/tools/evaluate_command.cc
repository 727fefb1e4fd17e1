// SPDX-FileCopyrightText: 2026 The Plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include <iostream>
#include <memory>
#include <nlohmann/json.hpp>
#include <stdexcept>
#include <utility>

#include "plumbline/evaluation/ply_reader.h"
#include "plumbline/evaluation/pose_evaluation.h"
#include "plumbline/georeference/georeference_file.h"
#include "plumbline/map/session_store.h"
#include "tools/commands.h"
#include "tools/geometry_report.h"
#include "tools/georeference.h"
#include "tools/original_names.h"
#include "tools/session_frame.h"
#include "tools/session_map.h"

namespace plumb::tools {
namespace {

using Json = nlohmann::ordered_json;

Json ToJson(const ErrorSummary& summary) {
  return {{"mean", summary.mean}, {"median", summary.median}, {"max", summary.max}};
}

Json ToJson(const PoseEvaluation& evaluation) {
  Json photos = Json::array();
  for (const PhotoError& photo : evaluation.photos) {
    photos.push_back({{"photo", photo.photo},
                      {"center_error_mm", photo.center_error_mm},
                      {"rotation_error_deg", photo.rotation_error_deg}});
  }
  return {{"registered", evaluation.num_registered},
          {"truth", evaluation.num_truth},
          {"missed", evaluation.missed},
          {"without_truth", evaluation.without_truth},
          {"wrong", evaluation.wrong},
          {"center_error_mm", ToJson(evaluation.center_error_mm)},
          {"rotation_error_deg", ToJson(evaluation.rotation_error_deg)},
          {"metres_per_map_unit", evaluation.world_from_map.scale},
          {"photos", photos}};
}

// Of the markers; how the map lies is in them too.
Json ToSurveyJson(const Georeference& georeference) {
  Json json = ToJson(georeference);
  for (const char* key : {"source", "coarse", "map_sequence", "earth_from_map", "gps"}) {
    json.erase(key);
  }
  return json;
}

struct EvaluateArguments {
  std::string poses;
  std::string mesh;
  GeometryTruth truth;
  GeoreferenceArguments georeference;  // With the session.
};

void AddOptions(CLI::App* command, EvaluateArguments* arguments) {
  command->add_option("--session", arguments->georeference.session, "Folder of the session")
      ->required();
  command->add_option("--truth",
                      arguments->poses,
                      "CSV: photo,qw,qx,qy,qz,center_x_m,center_y_m,center_z_m (cam_from_world "
                      "rotation, camera centre in metres)");
  command->add_option("--survey",
                      arguments->georeference.survey,
                      "Survey of coded markers, as plumbline georeference takes it");
  command->add_option(
      "--crs", arguments->georeference.crs, "Of the survey, instead of its own word");
  GeometryTruth* truth = &arguments->truth;
  command->add_option("--surface",
                      truth->surface,
                      "PLY of the true surface, a mesh in the frame of the true poses; faces whose "
                      "property main_wall is not 0 are the wall that is truly flat");
  command->add_option("--laser", truth->laser, "PLY of a scan, a point cloud in the same frame");
  command->add_option("--mesh",
                      arguments->mesh,
                      "PLY of a mesh as plumbline mesh writes it, or of any in the map's frame, to "
                      "be compared with the surface and the scan as well");
  truth->num_samples = 500'000;
  command
      ->add_option(
          "--samples", truth->num_samples, "Points at most of each truth, for completeness")
      ->check(CLI::PositiveNumber)
      ->capture_default_str();
  command
      ->add_option(
          "--wall-cell", truth->wall.cell_m, "Side of the squares that a bend shows in [m]")
      ->check(CLI::PositiveNumber)
      ->capture_default_str();
}

Json EvaluateByTruth(const EvaluateArguments& arguments,
                     const SessionStore& store,
                     const MapDelta& snapshot) {
  GeometryTruth truth = arguments.truth;
  truth.photos = ReadTruePoses(arguments.poses);
  const PoseEvaluation poses =
      EvaluatePoses(WithOriginalNames(snapshot.views_set, store.Photos()), truth.photos);
  if (poses.wrong.size() == poses.photos.size()) {
    std::cerr << "all " << poses.photos.size() << " poses are wrong: " << arguments.poses
              << " may be of another scene, or give its photos other names\n";
  }
  Json report = ToJson(poses);
  std::vector<Eigen::Vector3d> points_in_world;
  for (const LandmarkState& landmark : snapshot.landmarks_set) {
    points_in_world.push_back(poses.world_from_map * landmark.position_in_map);
  }
  ReportGeometry(truth, store.camera(), points_in_world, &report);
  if (!arguments.mesh.empty()) {
    TriangleMesh mesh = ReadPlyMesh(arguments.mesh);
    mesh.vertices =
        BroughtIntoMap(arguments.mesh, ReadPlyComments(arguments.mesh), std::move(mesh.vertices));
    for (Eigen::Vector3d& vertex : mesh.vertices) vertex = poses.world_from_map * vertex;
    ReportMesh(truth, store.camera(), mesh, &report);
  }
  return report;
}

ExitCode Evaluate(const EvaluateArguments& arguments) {
  const bool has_survey = !arguments.georeference.survey.empty();
  if (arguments.poses.empty() && !has_survey) {
    throw std::runtime_error("nothing to evaluate against; give --truth, --survey or both");
  }
  const bool has_geometry =
      !arguments.truth.surface.empty() || !arguments.truth.laser.empty() || !arguments.mesh.empty();
  if (arguments.poses.empty() && has_geometry) {
    throw std::runtime_error(
        "--surface, --laser and --mesh need the alignment by --truth; give it too");
  }
  if (!arguments.mesh.empty() && arguments.truth.surface.empty() && arguments.truth.laser.empty()) {
    throw std::runtime_error("--mesh: nothing to compare it with; give --surface, --laser or both");
  }
  const SessionStore store = SessionStore::OpenExisting(arguments.georeference.session);
  Json report = Json::object();
  const SessionMap map = ReadSessionMap(store);
  if (map.snapshot.views_set.empty()) {
    std::cerr << WhyNothingIsLocated(store) << "; there is nothing to evaluate\n";
    return kNothingLocated;
  }
  if (!arguments.poses.empty()) report = EvaluateByTruth(arguments, store, map.snapshot);
  if (has_survey) {
    Console console(&std::cerr, /*is_terminal=*/false);
    report["survey"] = ToSurveyJson(
        GeoreferenceSession(arguments.georeference, store, map.snapshot, &console).georeference);
  }
  report["refined"] = map.is_refined;
  std::cout << report.dump(2, ' ', false, Json::error_handler_t::replace) << '\n';
  return kDone;
}

}  // namespace

void AddEvaluateCommand(CLI::App* app, ExitCode* exit_code) {
  CLI::App* command = app->add_subcommand(
      "evaluate", "Compare a session's cameras, points and markers with their truth");
  command->footer(
      "Prints JSON: photos registered, mean, median and largest error of the camera centres [mm] "
      "and rotations [deg] after the similarity that fits the centres best, those of each photo, "
      "which are wrong (beyond 100 mm or 1 degree) and which have no truth. With --surface or "
      "--laser also the points' accuracy, completeness and F-score, and the bend of the flat wall "
      "[mm], with --mesh those of the mesh too. With --survey, which needs no --truth, the errors "
      "of control and check points [mm]; see docs/evaluation.md. Photos are paired by the names "
      "they had where they came from.\n" +
      std::string(kExitCodes));
  const auto arguments = std::make_shared<EvaluateArguments>();
  AddOptions(command, arguments.get());
  command->callback([arguments, exit_code] { *exit_code = Evaluate(*arguments); });
}

}  // namespace plumb::tools

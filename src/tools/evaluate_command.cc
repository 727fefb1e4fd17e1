// SPDX-FileCopyrightText: 2026 The Plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include <iostream>
#include <memory>
#include <nlohmann/json.hpp>

#include "plumbline/evaluation/pose_evaluation.h"
#include "plumbline/map/session_store.h"
#include "tools/commands.h"
#include "tools/original_names.h"

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
          {"center_error_mm", ToJson(evaluation.center_error_mm)},
          {"rotation_error_deg", ToJson(evaluation.rotation_error_deg)},
          {"metres_per_map_unit", evaluation.world_from_map.scale},
          {"photos", photos}};
}

struct EvaluateArguments {
  std::string session;
  std::string truth;
};

}  // namespace

void AddEvaluateCommand(CLI::App* app, ExitCode* exit_code) {
  CLI::App* command =
      app->add_subcommand("evaluate", "Compare the camera poses of a session with their truth");
  command->footer(
      "Prints JSON: photos registered, mean, median and largest error of the camera centres [mm] "
      "and rotations [deg] after the similarity that fits the centres best, and those of each "
      "photo. Photos are paired by the names they had where they came from.");
  const auto arguments = std::make_shared<EvaluateArguments>();
  command->add_option("--session", arguments->session, "Folder of the session")->required();
  command
      ->add_option("--truth",
                   arguments->truth,
                   "CSV: photo,qw,qx,qy,qz,center_x_m,center_y_m,center_z_m (cam_from_world "
                   "rotation, camera centre in metres)")
      ->required();
  command->callback([arguments, exit_code] {
    const std::vector<TruePose> truth = ReadTruePoses(arguments->truth);
    const SessionStore store = SessionStore::OpenExisting(arguments->session);
    const PoseEvaluation evaluation =
        EvaluatePoses(WithOriginalNames(store.Snapshot().views_set, store.Photos()), truth);
    std::cout << ToJson(evaluation).dump(2, ' ', false, Json::error_handler_t::replace) << '\n';
    *exit_code = kDone;
  });
}

}  // namespace plumb::tools

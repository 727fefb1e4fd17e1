// SPDX-FileCopyrightText: 2026 The Plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include <iostream>
#include <memory>
#include <nlohmann/json.hpp>
#include <stdexcept>

#include "plumbline/camera/camera.h"
#include "plumbline/common/atomic_file.h"
#include "plumbline/common/stopwatch.h"
#include "plumbline/image/photo_analysis.h"
#include "plumbline/map/run_report.h"
#include "tools/commands.h"
#include "tools/photo_list.h"

namespace plumb::tools {
namespace {

using Json = nlohmann::ordered_json;

struct CheckArguments {
  std::string photos;
  std::string camera;
};

Json CheckPhoto(const Camera& camera, const std::string& folder, const std::string& name) {
  std::vector<std::uint8_t> bytes;
  try {
    bytes = ReadFileBytes(folder + '/' + name);
  } catch (const std::runtime_error& error) {
    return {{"name", name}, {"usable", false}, {"detail", error.what()}};
  }
  const double cpu_before_s = CurrentProcessUsage().cpu_s;
  const Stopwatch stopwatch;
  const PhotoAnalysis analysis =
      AnalyzePhoto(FeatureOptions(), bytes, camera.width_px(), camera.height_px());
  return {{"name", name},
          {"usable", analysis.status == PhotoStatus::kOk},
          {"detail", analysis.detail},
          {"width_px", analysis.metadata.width_px},
          {"height_px", analysis.metadata.height_px},
          {"blur_px", analysis.blur_px},
          {"features", analysis.features.size()},
          {"wall_s", stopwatch.Seconds()},
          {"cpu_s", CurrentProcessUsage().cpu_s - cpu_before_s}};
}

// Prints a line for each photo; kNothingLocated if none is usable. Without a folder of photos the
// camera alone is checked.
ExitCode Check(const CheckArguments& arguments) {
  const Camera camera = ReadCameraYaml(arguments.camera);
  if (arguments.photos.empty()) return kDone;
  const PhotoListing listing = ListPhotos(arguments.photos);
  for (const std::string& line : Describe(listing)) std::cerr << line << '\n';
  ExitCode exit_code = kNothingLocated;
  for (const std::string& name : listing.photos) {
    const Json photo = CheckPhoto(camera, arguments.photos, name);
    std::cout << photo.dump(-1, ' ', false, Json::error_handler_t::replace) << std::endl;
    if (photo["usable"]) exit_code = kDone;
  }
  if (exit_code != kDone) std::cerr << "none of the photos is usable\n";
  return exit_code;
}

}  // namespace

void AddCheckCommand(CLI::App* app, ExitCode* exit_code) {
  CLI::App* command = app->add_subcommand(
      "check", "Say of a camera and of each photo of a folder whether it is usable, without a map");
  command->footer(
      "Prints one line of JSON a photo: whether it is usable and why not, size and blur [px], "
      "number of features, wall and CPU seconds of its decoding and features. Other files are "
      "named on standard error.\n" +
      std::string(kExitCodes));
  const auto arguments = std::make_shared<CheckArguments>();
  command->add_option(
      "--photos",
      arguments->photos,
      "Folder of photos, with its sub-folders; without, the camera alone is checked");
  command->add_option("--camera", arguments->camera, "Lens: ROS camera_info YAML, lengths in px")
      ->required();
  command->callback([arguments, exit_code] { *exit_code = Check(*arguments); });
}

}  // namespace plumb::tools

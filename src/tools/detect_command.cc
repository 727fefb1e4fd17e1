// SPDX-FileCopyrightText: 2026 The Plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <filesystem>
#include <iostream>
#include <memory>
#include <stdexcept>

#include "plumbline/common/atomic_file.h"
#include "plumbline/common/options.h"
#include "tools/commands.h"
#include "tools/count_text.h"
#include "tools/detect.h"
#include "tools/options_yaml.h"
#include "tools/photo_list.h"

namespace plumb::tools {
namespace {

struct DetectArguments {
  std::string photos;
  std::string camera;
  std::string output = "csv";
  std::vector<std::string> settings;
};

// "csv" or "json", by the word itself or the ending of a file's name.
bool IsJsonOutput(const std::string& output) {
  const std::string ending = std::filesystem::path(output).extension();
  if (output == "json" || ending == ".json") return true;
  if (output == "csv" || ending == ".csv") return false;
  throw std::runtime_error("--output: \"" + output +
                           "\" is neither csv nor json, nor a file that ends in one of them");
}

MarkerDetectorOptions ReadOptions(const std::vector<std::string>& settings) {
  MarkerDetectorOptions options;
  for (const std::string& setting : settings) {
    ReadValue(ParseSetting(setting), {"--set " + setting, ""}, &options);
  }
  ThrowIfProblems("marker detector", options.Problems());
  return options;
}

// kNothingLocated if no photo could be searched.
ExitCode Detect(const DetectArguments& arguments) {
  const bool is_json = IsJsonOutput(arguments.output);
  const MarkerDetectorOptions options = ReadOptions(arguments.settings);
  std::optional<Camera> camera;
  if (!arguments.camera.empty()) camera = ReadCameraYaml(arguments.camera);
  const PhotoListing listing = ListPhotos(arguments.photos);
  for (const std::string& line : Describe(listing)) std::cerr << line << '\n';
  std::vector<DetectedPhoto> photos;
  for (const std::string& name : listing.photos) {
    photos.push_back(DetectInPhoto(options, camera, arguments.photos, name));
    const DetectedPhoto& photo = photos.back();
    std::cerr << name << ": "
              << (photo.problem.empty() ? CountOf(photo.markers.size(), "marker") : photo.problem)
              << '\n';
  }
  const std::string text = is_json ? ToJson(photos) : ToCsv(photos);
  if (arguments.output == "csv" || arguments.output == "json") {
    std::cout << text;
  } else {
    WriteFileAtomically(arguments.output, text);
  }
  const bool is_any_searched =
      std::any_of(photos.begin(), photos.end(), [](const DetectedPhoto& photo) {
        return photo.problem.empty();
      });
  if (!is_any_searched) std::cerr << "none of the photos could be searched\n";
  return is_any_searched ? kDone : kNothingLocated;
}

}  // namespace

void AddDetectCommand(CLI::App* app, ExitCode* exit_code) {
  CLI::App* command = app->add_subcommand("detect", "Find the coded markers in a folder's photos");
  command->footer(
      "Gives each marker's ID, centre with covariance, outer ellipse [px], probability of the "
      "code, and share of the grey values that the marker explains. Pixel (0, 0) is the top-left "
      "pixel's centre. What became of each photo is said on standard error.\n" +
      std::string(kExitCodes));
  const auto arguments = std::make_shared<DetectArguments>();
  command->add_option("--photos", arguments->photos, "Folder of photos, with its sub-folders")
      ->required();
  command->add_option(
      "--camera",
      arguments->camera,
      "Lens, if known: ROS camera_info YAML. Centre and ellipse stay those of the photo "
      "as taken; pixel_from_marker of the JSON is then without distortion");
  command
      ->add_option("--output",
                   arguments->output,
                   "csv or json, to standard output, or a file that ends in .csv or .json")
      ->capture_default_str();
  command->add_option("--set", arguments->settings, "KEY=VALUE: an option of the detector; repeat")
      ->allow_extra_args(false);
  command->callback([arguments, exit_code] { *exit_code = Detect(*arguments); });
}

}  // namespace plumb::tools

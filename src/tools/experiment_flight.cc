// SPDX-FileCopyrightText: 2026 The Plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "tools/experiment_flight.h"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <random>
#include <sstream>
#include <stdexcept>

#include "plumbline/simulation/facade.h"
#include "tools/scenario_yaml.h"

namespace plumb::tools {
namespace {

namespace fs = std::filesystem;

constexpr int kMinControlPoints = 3;

// Throws unless the file is there.
const std::string& Existing(const std::string& path) {
  if (fs::is_regular_file(path)) return path;
  throw std::runtime_error(
      path +
      ": is missing; --flight must be a folder made by plumbline simulate with "
      "its ground truth");
}

struct RowSums {
  double distance_m = 0.0;
  int num_photos = 0;
};

// Lines of photo,row,distance_m.
void ReadRows(const std::string& path, ExperimentFlight* flight) {
  std::ifstream file(Existing(path));
  std::map<std::string, RowSums> sums;
  std::string line;
  for (int number = 1; std::getline(file, line); ++number) {
    if (line.empty() || line[0] == '#' || line.rfind("photo,", 0) == 0) continue;
    std::istringstream fields(line);
    FlightPhoto photo;
    double distance_m = 0.0;
    const bool is_good = std::getline(fields, photo.name, ',') &&
                         std::getline(fields, photo.row, ',') && fields >> distance_m &&
                         distance_m > 0.0 && !photo.row.empty();
    if (!is_good) {
      throw std::runtime_error(
          path + ": line " + std::to_string(number) +
          " is not photo,row,distance_m; let plumbline simulate write it anew");
    }
    if (!fs::is_regular_file(flight->PhotoPath(photo.name))) continue;  // Not taken (yet).
    RowSums& sum = sums[photo.row];
    sum.distance_m += distance_m;
    ++sum.num_photos;
    flight->photos.push_back(photo);
  }
  for (const auto& [row, sum] : sums) {
    flight->rows.push_back({row, sum.distance_m / sum.num_photos, sum.num_photos});
  }
  std::stable_sort(flight->rows.begin(), flight->rows.end(), [](const auto& a, const auto& b) {
    return a.distance_m > b.distance_m;
  });
}

int NumControlPoints(const Survey& survey) {
  return static_cast<int>(std::count_if(survey.targets.begin(),
                                        survey.targets.end(),
                                        [](const auto& target) { return !target.is_check; }));
}

void CheckFlight(const ExperimentFlight& flight) {
  if (flight.rows.size() < 2) {
    throw std::runtime_error(flight.folder + ": has photos of " +
                             (flight.rows.empty() ? "no row" : "row " + flight.rows[0].name) +
                             " only; the experiment compares rows at several distances: simulate "
                             "the others too, e.g. scenario multiscale_500 without --rows");
  }
  const int num_control = NumControlPoints(flight.survey);
  const bool has_check = num_control < static_cast<int>(flight.survey.targets.size());
  if (num_control >= kMinControlPoints && has_check) return;
  throw std::runtime_error(
      flight.survey.source + ": has " + std::to_string(num_control) + " control points and " +
      std::to_string(flight.survey.targets.size() - static_cast<std::size_t>(num_control)) +
      " check points; three control points and a check point are the least");
}

// In [0, 1), the same from every standard library.
double Uniform(std::mt19937_64* random) {
  return static_cast<double>((*random)() >> 11) / 9007199254740992.0;  // 2^53.
}

double EitherSide(double least, double most, std::mt19937_64* random) {
  const double size = least + (most - least) * Uniform(random);
  return Uniform(random) < 0.5 ? size : -size;
}

}  // namespace

bool SplitSurvey(Survey* survey) {
  const int num_control = NumControlPoints(*survey);
  if (num_control < static_cast<int>(survey->targets.size())) return false;
  bool is_split = false;
  for (std::size_t i = 1; i < survey->targets.size(); i += 3) {
    if (NumControlPoints(*survey) <= kMinControlPoints) break;
    survey->targets[i].is_check = true;
    is_split = true;
  }
  return is_split;
}

ExperimentFlight ReadExperimentFlight(const std::string& folder) {
  ExperimentFlight flight{
      folder, ReadCameraYaml(Existing(folder + "/camera.yaml")), {}, false, {}, {}, {}};
  flight.survey = ReadSurvey(Existing(folder + "/survey.csv"));
  flight.has_split_survey = SplitSurvey(&flight.survey);
  ReadRows(folder + "/ground_truth/rows.csv", &flight);
  Existing(flight.SurfacePath());
  CheckFlight(flight);
  const World world = BuildFacade(ReadScenario(Existing(folder + "/scenario.yaml")).facade);
  for (const Plate& plate : world.plates) {
    flight.true_targets[plate.id] = plate.world_from_plate.translation;
  }
  return flight;
}

Camera MakeFaultyCamera(const Camera& camera, std::uint32_t seed) {
  std::mt19937_64 random(seed);
  const double focal = 1.0 + EitherSide(0.001, 0.003, &random);
  const double corner_px = EitherSide(2.0, 4.0, &random);
  LensParameters<double> lens = camera.lens();
  const double focal_px = camera.MeanFocalLength();
  const double radius = 0.5 * std::hypot(camera.width_px(), camera.height_px()) / focal_px;
  lens[kFx] *= focal;
  lens[kFy] *= focal;
  lens[kK1] += corner_px / focal_px / std::pow(radius, 3);
  return {camera.name() + "_faulty_" + std::to_string(seed),
          camera.width_px(),
          camera.height_px(),
          camera.model(),
          lens};
}

}  // namespace plumb::tools

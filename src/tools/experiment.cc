// SPDX-FileCopyrightText: 2026 The Plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "tools/experiment.h"

#include <algorithm>
#include <filesystem>
#include <mutex>
#include <stdexcept>
#include <thread>

#include "image/parallel_for.h"
#include "plumbline/common/atomic_file.h"
#include "plumbline/common/stopwatch.h"
#include "plumbline/evaluation/ply_reader.h"
#include "plumbline/map/run_report.h"
#include "tools/detect.h"
#include "tools/experiment_cell.h"
#include "tools/experiment_report.h"
#include "tools/options_yaml.h"

namespace plumb::tools {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

ExperimentOptions ReadOptions(const std::vector<std::string>& settings) {
  ExperimentOptions options;
  for (const std::string& setting : settings) {
    ReadValue(ParseSetting(setting), {"--set " + setting, ""}, &options);
  }
  std::string problems;
  for (const std::string& problem : options.Problems()) {
    problems += (problems.empty() ? "" : "; ") + problem;
  }
  if (!problems.empty()) throw std::runtime_error("--set: " + problems);
  return options;
}

// Rows far to near, then all; or those that are wanted, in that order.
std::vector<std::string> ChooseRows(const ExperimentArguments& arguments,
                                    const ExperimentFlight& flight) {
  std::vector<std::string> known;
  for (const FlightRow& row : flight.rows) known.push_back(row.name);
  known.emplace_back(kAllRows);
  const auto is_in = [](const std::vector<std::string>& list, const std::string& word) {
    return std::find(list.begin(), list.end(), word) != list.end();
  };
  for (const std::string& row : arguments.rows) {
    if (is_in(known, row)) continue;
    std::string text;
    for (const std::string& name : known) text += ' ' + name;
    throw std::runtime_error("--rows: the flight has no row \"" + row + "\"; there are:" + text);
  }
  std::vector<std::string> chosen;
  for (const std::string& row : known) {
    if (arguments.rows.empty() || is_in(arguments.rows, row)) chosen.push_back(row);
  }
  return chosen;
}

std::string CellPath(const std::string& output, const CellKey& key) {
  return output + "/cells/" + key.rows + "-seed" + std::to_string(key.seed) + ".json";
}

Json ReadJson(const std::string& path) {
  const std::vector<std::uint8_t> bytes = ReadFileBytes(path);
  try {
    return Json::parse(bytes.begin(), bytes.end());
  } catch (const Json::exception& error) {
    throw std::runtime_error(path + ": is damaged: " + error.what() +
                             "; remove it, it is then computed again");
  }
}

void WriteJson(const std::string& path, const Json& json) {
  WriteFileAtomically(path, json.dump(1, ' ', false, Json::error_handler_t::replace) + '\n');
}

// Makes the folder, or takes one of the same flight and options.
void OpenOutput(const ExperimentArguments& arguments,
                const ExperimentFlight& flight,
                const ExperimentOptions& options) {
  const std::string path = arguments.output + "/experiment.json";
  const Json wanted = {{"flight", fs::weakly_canonical(arguments.flight).string()},
                       {"photos", flight.photos.size()},
                       {"options", OptionsToJson(options)}};
  if (fs::exists(path)) {
    if (ReadJson(path) == wanted) return;
    throw std::runtime_error(path +
                             ": is of another flight, other photos or other options; choose a new "
                             "--output, or remove this one");
  }
  std::error_code error;
  fs::create_directories(arguments.output + "/cells", error);
  if (error) {
    throw std::runtime_error(arguments.output + ": cannot be made a folder: " + error.message() +
                             "; choose another --output");
  }
  WriteJson(path, wanted);
}

// Analyses the photos that the cells need, and finds their markers, each in a thread.
class Preparation {
 public:
  Preparation(ExperimentData* data, int num_threads, Console* console)
      : data_(*data), num_threads_(num_threads), console_(*console) {}

  // False if it was stopped.
  bool Run(const std::vector<CellKey>& cells, const std::atomic<bool>& stop) {
    const auto is_needed = [&](const FlightPhoto& photo) {
      return std::any_of(cells.begin(), cells.end(), [&](const CellKey& key) {
        return key.rows == kAllRows || key.rows == photo.row;
      });
    };
    for (const FlightPhoto& photo : data_.flight.photos) {
      if (is_needed(photo)) data_.photos.push_back({photo, {}, {}});
    }
    // By the first seed's lens; a centre does not move with so small a fault.
    detection_camera_ = MakeFaultyCamera(data_.flight.camera, 1);
    ParallelFor(num_threads_, static_cast<int>(data_.photos.size()), 1, [&](int begin, int end) {
      for (int i = begin; i < end && !stop; ++i)
        Prepare(&data_.photos[static_cast<std::size_t>(i)]);
    });
    return !stop;
  }

 private:
  void Prepare(PreparedPhoto* photo) {
    const Camera& camera = *detection_camera_;
    const std::vector<std::uint8_t> bytes =
        ReadFileBytes(data_.flight.PhotoPath(photo->photo.name));
    photo->analysis = AnalyzePhoto(
        data_.options.reconstruction.features, bytes, camera.width_px(), camera.height_px());
    MarkerDetectorOptions detector;
    detector.num_threads = 1;
    DetectedPhoto detected =
        DetectInPhoto(detector, camera, data_.flight.folder + "/photos", photo->photo.name);
    if (!detected.problem.empty()) {
      throw std::runtime_error(data_.flight.PhotoPath(photo->photo.name) + ": " + detected.problem +
                               "; remove it, and let plumbline simulate take it "
                               "again");
    }
    photo->markers = std::move(detected.markers);
    const std::lock_guard<std::mutex> lock(mutex_);
    console_.ShowProgress(++num_done_, data_.photos.size(), photo->photo.name);
  }

  ExperimentData& data_;
  int num_threads_;
  Console& console_;
  std::optional<Camera> detection_camera_;
  std::mutex mutex_;
  std::size_t num_done_ = 0;
};

void ReadTruth(ExperimentData* data) {
  data->surface = ReadPlyMesh(data->flight.SurfacePath());
  data->surface_index = std::make_unique<MeshIndex>(data->surface);
  if (fs::exists(data->flight.LaserPath())) {
    data->laser_index = std::make_unique<CloudIndex>(ReadPlyPoints(data->flight.LaserPath()));
  }
}

void RunCells(const ExperimentArguments& arguments,
              const ExperimentData& data,
              const std::vector<CellKey>& cells,
              int num_threads,
              const std::atomic<bool>& stop,
              Console* console) {
  std::mutex mutex;
  ParallelFor(num_threads, static_cast<int>(cells.size()), 1, [&](int begin, int end) {
    for (int i = begin; i < end && !stop; ++i) {
      const CellKey& key = cells[static_cast<std::size_t>(i)];
      const Stopwatch wall;
      Json json = RunCell(data, key);
      json["wall_s"] = wall.Seconds();
      WriteJson(CellPath(arguments.output, key), json);
      const std::lock_guard<std::mutex> lock(mutex);
      console->PrintLine("rows " + key.rows + ", seed " + std::to_string(key.seed) + ": " +
                         std::to_string(json["located"].get<int>()) + " of " +
                         std::to_string(json["photos"].get<int>()) + " photos located");
    }
  });
}

}  // namespace

ExitCode RunMultiscaleExperiment(const ExperimentArguments& arguments,
                                 const std::atomic<bool>& stop,
                                 Console* console) {
  ExperimentData data{ReadExperimentFlight(arguments.flight),
                      ReadOptions(arguments.settings),
                      {},
                      {},
                      nullptr,
                      nullptr};
  const std::vector<std::string> rows = ChooseRows(arguments, data.flight);
  OpenOutput(arguments, data.flight, data.options);
  std::vector<CellKey> cells;
  std::vector<CellKey> missing;
  for (int seed = 1; seed <= arguments.num_seeds; ++seed) {
    for (const std::string& row : rows) {
      cells.push_back({row, static_cast<std::uint32_t>(seed)});
      if (!fs::exists(CellPath(arguments.output, cells.back()))) missing.push_back(cells.back());
    }
  }
  console->PrintLine(std::to_string(missing.size()) + " of " + std::to_string(cells.size()) +
                     " reconstructions to do");
  const int num_threads = arguments.num_threads > 0
                              ? arguments.num_threads
                              : static_cast<int>(std::thread::hardware_concurrency());
  if (!missing.empty()) {
    ReadTruth(&data);
    if (!Preparation(&data, num_threads, console).Run(missing, stop)) return kInterrupted;
    RunCells(arguments, data, missing, num_threads, stop, console);
  }
  if (stop) {
    console->PrintLine("interrupted; the same command goes on after the cells that are done");
    return kInterrupted;
  }
  std::vector<Json> results;
  for (const CellKey& key : cells) results.push_back(ReadJson(CellPath(arguments.output, key)));
  for (const std::string& line :
       WriteExperimentReport(data.flight, rows, results, arguments.output)) {
    console->PrintLine(line);
  }
  return kDone;
}

}  // namespace plumb::tools

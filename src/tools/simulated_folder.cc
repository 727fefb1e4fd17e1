// SPDX-FileCopyrightText: 2026 The Plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "tools/simulated_folder.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <iomanip>
#include <sstream>
#include <stdexcept>

#include "plumbline/common/atomic_file.h"
#include "plumbline/simulation/laser_scan.h"
#include "plumbline/simulation/surface_ply.h"
#include "plumbline/simulation/survey.h"
#include "tools/scenario_yaml.h"

namespace plumb::tools {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

constexpr char kReadme[] = R"(# A simulated flight
Made by `plumbline simulate`; `scenario.yaml` is all that it was made of. The same scenario and seed
give the same bytes. Lengths in metres. The world: x right along the facade, y into the building,
z up; the main wall lies in y = 0 with its lower left corner at the origin; x is east, y north. A
scenario with a `floor` has no wall: coded markers lie about the origin in z = 0.

| file | holds |
|---|---|
| `photos/` | the photos as the camera leaves them, named by time; what follows the number is the row |
| `camera.yaml` | the true lens, ROS camera_info, px |
| `camera_wrong.yaml` | a lens that is off on purpose: a careless calibration |
| `telemetry.csv` | what the MAV measured: UTC [s since 1970], WGS 84 with ellipsoidal height, attitude (Hamilton quaternion ENU from body, body x forward, y left, z up), and the number and name of the photo taken then |
| `survey.csv` | control points as a total station measures them, in the world |
| `flight.bag` | the photos as messages `/plumbline/photo`: `roslaunch plumbline replay.launch bag:=` |
| `ground_truth/poses.csv` | true poses: Hamilton quaternion cam_from_world (camera x right, y down, z forward), centre in the world |
| `ground_truth/rows.csv` | row and planned distance of each photo |
| `ground_truth/laser.ply` | what a laser scanner on the ground sees, with its noise; not of a floor |
| `ground_truth/surface.ply` | the surface itself |
| `scenario.yaml` | the scenario, every value of it |
)";

// The first value in which two scenarios differ and what it is in both, as /seed: 1 there, 2 now.
// Their descriptions only if nothing else does: they do not say what is different.
std::string FirstDifference(const Json& there, const Json& now) {
  const Json changes = Json::diff(there, now);
  if (changes.empty()) return "its form";
  const auto telling = std::find_if(changes.begin(), changes.end(), [](const Json& change) {
    return change["path"] != "/description";
  });
  const Json& change = telling == changes.end() ? changes[0] : *telling;
  const std::string path = change["path"];
  if (change["op"] == "remove") return path + ", which is only there";
  if (change["op"] == "add") return path + ", which is only in the new one";
  return path + ": " + there.at(Json::json_pointer(path)).dump() + " there, " +
         change["value"].dump() + " now";
}

void CheckSameScenario(const std::string& folder, const Scenario& scenario) {
  const std::string cure = "; choose a new --output, or remove this folder";
  const std::vector<std::uint8_t> bytes = ReadFileBytes(folder + "/scenario.yaml");
  const Json there = Json::parse(bytes.begin(), bytes.end(), nullptr, /*allow_exceptions=*/false);
  if (there.is_discarded()) {
    throw std::runtime_error(folder + "/scenario.yaml: was changed by hand" + cure);
  }
  if (there == ToJson(scenario)) return;
  throw std::runtime_error(folder + ": holds a flight of another scenario, which differs in " +
                           FirstDifference(there, ToJson(scenario)) + cure);
}

void RemoveTemporaryFiles(const fs::path& folder) {
  for (const auto& entry : fs::directory_iterator(folder)) {
    if (IsTemporaryFileName(entry.path().filename())) fs::remove(entry.path());
  }
}

std::ostringstream Table(const char* header) {
  std::ostringstream text;
  text << std::setprecision(15) << header;
  return text;
}

std::string PosesCsv(const Photographer& photographer, const std::vector<std::size_t>& photo_idxs) {
  std::ostringstream text = Table(
      "# cam_from_world rotation (Hamilton, w first; camera x right, y down, z forward), camera "
      "centre in world [m]\nphoto,qw,qx,qy,qz,center_x_m,center_y_m,center_z_m\n");
  for (const std::size_t idx : photo_idxs) {
    const PlannedPhoto& photo = photographer.photos()[idx];
    const Eigen::Quaterniond& rotation = photo.cam_from_world.rotation;
    const Eigen::Vector3d center = photo.cam_from_world.TargetOriginInSource();
    text << photo.name << ',' << rotation.w() << ',' << rotation.x() << ',' << rotation.y() << ','
         << rotation.z() << ',' << center.x() << ',' << center.y() << ',' << center.z() << '\n';
  }
  return text.str();
}

std::string RowsCsv(const Photographer& photographer, const std::vector<std::size_t>& photo_idxs) {
  std::ostringstream text = Table("photo,row,distance_m\n");
  for (const std::size_t idx : photo_idxs) {
    const PlannedPhoto& photo = photographer.photos()[idx];
    text << photo.name << ',' << photo.row << ',' << photo.distance_m << '\n';
  }
  return text.str();
}

// Seconds with all nine digits, which a double does not hold.
std::string SecondsText(Timestamp time) {
  constexpr std::int64_t kNsPerSecond = 1'000'000'000;
  const std::string fraction = std::to_string(kNsPerSecond + time.ns % kNsPerSecond).substr(1);
  return std::to_string(time.ns / kNsPerSecond) + '.' + fraction;
}

std::string TelemetryCsv(const Photographer& photographer) {
  std::ostringstream text = Table(
      "# UTC since 1970 [s]; WGS 84, ellipsoidal height; ENU from body (Hamilton, w first; body x "
      "forward, y left, z up); number and name of the photo taken then\n"
      "time_s,lat_deg,lon_deg,alt_ellipsoid_m,qw,qx,qy,qz,photo_number,photo\n");
  for (const TelemetrySample& sample : photographer.telemetry()) {
    text << SecondsText(sample.time) << ',';
    if (sample.position) {
      text << sample.position->lat_deg << ',' << sample.position->lon_deg << ','
           << sample.position->alt_m.value_or(0.0) << ',';
    } else {
      text << ",,,";
    }
    const Eigen::Quaterniond& rotation = sample.enu_from_body_rotation;
    text << rotation.w() << ',' << rotation.x() << ',' << rotation.y() << ',' << rotation.z();
    if (sample.photo_idx < 0) {
      text << ",,\n";
    } else {
      const auto idx = static_cast<std::size_t>(sample.photo_idx);
      text << ',' << idx + 1 << ',' << photographer.photos()[idx].name << '\n';
    }
  }
  return text.str();
}

}  // namespace

void OpenSimulatedFolder(const std::string& folder, const Scenario& scenario) {
  try {
    if (fs::is_regular_file(folder)) {
      throw std::runtime_error(folder + ": is a file; name a folder as --output");
    }
    if (fs::exists(folder + "/scenario.yaml")) {
      CheckSameScenario(folder, scenario);
    } else if (fs::exists(folder) && !fs::is_empty(folder)) {
      throw std::runtime_error(folder +
                               ": holds something else than a simulated flight; choose a new "
                               "--output");
    }
    fs::create_directories(folder + "/photos");
    fs::create_directories(folder + "/ground_truth");
    for (const char* part : {"", "/photos", "/ground_truth"}) RemoveTemporaryFiles(folder + part);
  } catch (const fs::filesystem_error& error) {
    throw std::runtime_error(folder + ": cannot be made a folder: " + error.code().message() +
                             "; choose another --output");
  }
}

std::string PhotoFile(const std::string& folder, const PlannedPhoto& photo) {
  return folder + "/photos/" + photo.name;
}

void WriteFlightFiles(const Photographer& photographer,
                      const std::vector<std::size_t>& photo_idxs,
                      const std::string& folder) {
  const LensOptions& lens = photographer.scenario().lens;
  WriteFileAtomically(folder + "/scenario.yaml", ToJson(photographer.scenario()).dump(2) + '\n');
  WriteFileAtomically(folder + "/README.md", kReadme);
  WriteFileAtomically(folder + "/camera.yaml", ToCameraYaml(photographer.camera()));
  WriteFileAtomically(folder + "/camera_wrong.yaml", ToCameraYaml(MakeWrongCamera(lens)));
  WriteFileAtomically(folder + "/telemetry.csv", TelemetryCsv(photographer));
  const std::string truth = folder + "/ground_truth/";
  WriteFileAtomically(truth + "poses.csv", PosesCsv(photographer, photo_idxs));
  WriteFileAtomically(truth + "rows.csv", RowsCsv(photographer, photo_idxs));
  const SurveyOptions& survey = photographer.scenario().survey;
  WriteSurveyCsv(SurveyTargets(photographer.world(), survey), folder + "/survey.csv");
}

void WriteTrueSurface(const Photographer& photographer,
                      int num_threads,
                      const std::string& folder) {
  const std::string surface = folder + "/ground_truth/surface.ply";
  const std::string laser = folder + "/ground_truth/laser.ply";
  if (!fs::exists(surface)) WriteSurfacePly(photographer.world(), surface);
  if (fs::exists(laser)) return;
  const Scenario& scenario = photographer.scenario();
  if (scenario.floor.num_photos > 0) return;
  WriteLaserPly(ScanFacade(photographer.world(),
                           photographer.renderer(),
                           scenario.facade,
                           scenario.laser,
                           num_threads),
                laser);
}

}  // namespace plumb::tools

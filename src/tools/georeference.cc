// SPDX-FileCopyrightText: 2026 The Plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "tools/georeference.h"

#include <algorithm>
#include <filesystem>
#include <map>
#include <mutex>
#include <stdexcept>

#include "image/parallel_for.h"
#include "plumbline/common/atomic_file.h"
#include "plumbline/export/colmap_text.h"
#include "plumbline/georeference/georeference_file.h"
#include "plumbline/marker/codebook.h"
#include "tools/detect.h"
#include "tools/options_yaml.h"
#include "tools/original_names.h"

namespace plumb::tools {
namespace {

GeoreferencerOptions ReadOptions(const std::vector<std::string>& settings) {
  GeoreferencerOptions options;
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

std::optional<Survey> ReadSurveyOf(const GeoreferenceArguments& arguments) {
  if (arguments.survey.empty()) return std::nullopt;
  SurveyReading reading;
  reading.crs = arguments.crs;
  reading.heights = arguments.heights;
  return ReadSurvey(arguments.survey, reading);
}

// A survey of points that a person pointed at needs no detector.
bool NeedsMarkers(const std::optional<Survey>& survey) {
  const int num_markers = MarkerCodebook::Get().size();
  return survey && std::any_of(survey->targets.begin(),
                               survey->targets.end(),
                               [&](const SurveyTarget& target) { return target.id < num_markers; });
}

// One photo a thread, each in a thread of its own: decoding too takes its time.
void FindMarkers(const std::string& folder,
                 const Camera& camera,
                 const std::vector<ViewState>& views,
                 const std::map<PhotoId, std::string>& file_of_photo,
                 int num_threads,
                 Georeferencer* georeferencer,
                 Console* console) {
  MarkerDetectorOptions options;
  options.num_threads = 1;
  std::mutex mutex;
  std::size_t num_done = 0;
  ParallelFor(num_threads, static_cast<int>(views.size()), 1, [&](int begin, int end) {
    for (int i = begin; i < end; ++i) {
      const ViewState& view = views[static_cast<std::size_t>(i)];
      DetectedPhoto photo = DetectInPhoto(options, camera, folder, file_of_photo.at(view.photo));
      const std::lock_guard<std::mutex> lock(mutex);
      console->ShowProgress(++num_done, views.size(), view.name);
      if (photo.problem.empty()) {
        georeferencer->SetMarkers(view.photo, std::move(photo.markers));
      } else {
        console->PrintLine(view.name + ": left out: " + photo.problem);
      }
    }
  });
}

void SetPositions(const std::vector<StoredPhoto>& photos, Georeferencer* georeferencer) {
  for (const StoredPhoto& photo : photos) {
    if (photo.analysis && photo.analysis->metadata.position) {
      georeferencer->SetPosition(photo.id, *photo.analysis->metadata.position);
    }
  }
}

std::string JoinedErrors(const Georeference& georeference) {
  std::string text;
  for (const Finding& finding : georeference.findings) {
    if (finding.severity != Finding::Severity::kError) continue;
    text += (text.empty() ? "" : "; ") + finding.text;
  }
  return text;
}

}  // namespace

std::string GeoreferencePath(const std::string& session) {
  return session + "/export/georeference.json";
}

SessionGeoreference GeoreferenceSession(const GeoreferenceArguments& arguments,
                                        const SessionStore& store,
                                        Console* console) {
  const GeoreferencerOptions options = ReadOptions(arguments.settings);
  SessionGeoreference result;
  result.survey = ReadSurveyOf(arguments);
  MapDelta snapshot = store.Snapshot();
  if (snapshot.views_set.empty()) {
    throw std::runtime_error(store.folder() +
                             ": no photo is located; run plumbline reconstruct first");
  }
  const std::vector<StoredPhoto> photos = store.Photos();
  std::map<PhotoId, std::string> file_of_photo;
  for (const StoredPhoto& photo : photos) file_of_photo[photo.id] = photo.name;
  snapshot.views_set = WithOriginalNames(snapshot.views_set, photos);
  const Camera camera = CameraOf(snapshot, store.camera());
  Georeferencer georeferencer(options, camera);
  georeferencer.Apply(snapshot);
  SetPositions(photos, &georeferencer);
  if (result.survey) georeferencer.SetSurvey(*result.survey);
  if (NeedsMarkers(result.survey)) {
    FindMarkers(store.folder() + "/photos",
                camera,
                snapshot.views_set,
                file_of_photo,
                arguments.num_threads,
                &georeferencer,
                console);
  }
  result.georeference = georeferencer.Update();
  result.sightings = georeferencer.Sightings();
  return result;
}

void WriteSessionGeoreference(const GeoreferenceArguments& arguments, Console* console) {
  const SessionStore store = SessionStore::OpenExisting(arguments.session);
  const SessionGeoreference result = GeoreferenceSession(arguments, store, console);
  const Georeference& georeference = result.georeference;
  for (const std::string& line : Describe(georeference)) console->PrintLine(line);
  const std::string errors = JoinedErrors(georeference);
  if (!errors.empty()) throw std::runtime_error(errors);
  if (georeference.source == GeoreferenceSource::kNone) {
    throw std::runtime_error(arguments.session +
                             ": no survey was given, and the photos' GPS does not place the model: "
                             "that needs three located photos with position and height, not in a "
                             "line; give --survey");
  }
  const std::string path = GeoreferencePath(arguments.session);
  std::filesystem::create_directories(std::filesystem::path(path).parent_path());
  WriteFileAtomically(
      path,
      ToJson(georeference).dump(2, ' ', false, nlohmann::json::error_handler_t::replace) + '\n');
  console->PrintLine("wrote " + path);
  if (georeference.source != GeoreferenceSource::kTargets || result.survey->crs == kLocalCrs)
    return;
  const std::string gcp_path = arguments.session + "/export/gcp_list.txt";
  WriteFileAtomically(gcp_path, ToGcpList(*result.survey, result.sightings));
  console->PrintLine("wrote " + gcp_path);
}

}  // namespace plumb::tools

// SPDX-FileCopyrightText: 2026 The Plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "tools/georeference.h"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <iomanip>
#include <map>
#include <mutex>
#include <sstream>
#include <stdexcept>
#include <utility>

#include "image/parallel_for.h"
#include "plumbline/common/atomic_file.h"
#include "plumbline/export/colmap_text.h"
#include "plumbline/georeference/georeference_file.h"
#include "plumbline/marker/codebook.h"
#include "plumbline/sfm/map_refinement.h"
#include "plumbline/sfm/stored_session.h"
#include "tools/detect.h"
#include "tools/export_folder.h"
#include "tools/options_yaml.h"
#include "tools/original_names.h"
#include "tools/session_map.h"

namespace plumb::tools {
namespace {

constexpr char kGcpList[] = "gcp_list.txt";

struct Settings {
  GeoreferencerOptions georeferencer;
  RefinementOptions refinement;
};

template <typename Visitor>
void VisitFields(Settings& settings, Visitor&& visit) {
  VisitFields(settings.georeferencer, visit);
  visit("refinement", settings.refinement);
}

Settings ReadSettings(const std::vector<std::string>& texts) {
  Settings settings;
  for (const std::string& text : texts) {
    ReadValue(ParseSetting(text), {"--set " + text, ""}, &settings);
  }
  ProblemList list;
  list.Append("refinement", settings.refinement.Problems());
  std::vector<std::string> all = settings.georeferencer.Problems();
  const std::vector<std::string> of_refinement = list.Take();
  all.insert(all.end(), of_refinement.begin(), of_refinement.end());
  std::string problems;
  for (const std::string& problem : all) {
    problems += (problems.empty() ? "" : "; ") + problem;
  }
  if (!problems.empty()) throw std::runtime_error("--set: " + problems);
  return settings;
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

// What the bundle did, in a line.
std::string SummaryOf(const MapRefinement& refinement, const Camera& before) {
  std::ostringstream line;
  line << std::fixed << std::setprecision(2) << "refined: focal length " << before.MeanFocalLength()
       << " -> " << refinement.camera.MeanFocalLength() << " px; cost "
       << refinement.first.initial_cost << " -> " << refinement.last.final_cost << "; "
       << refinement.num_removed << " observations left out";
  return line.str();
}

// What a refined lens is to be held against; empty if it hardly changed. From photos at one
// distance before a flat wall the focal length and the distance can change together, and the
// markers, which lie in the wall, do not tell.
std::string LensWarning(const MapRefinement& refinement, const Camera& before) {
  constexpr double kMaxChange = 0.003;  // A calibration that is off by more was of another camera.
  const double change = refinement.camera.MeanFocalLength() / before.MeanFocalLength() - 1.0;
  if (std::abs(change) <= kMaxChange) return "";
  std::ostringstream line;
  line
      << std::fixed << std::setprecision(2) << "warning: the focal length changed by "
      << 100.0 * change
      << " %, more than a calibration is usually off. Photos from one distance leave it open: what "
         "lies before or behind the wall may be worse than before, and no target tells. If the "
         "camera was calibrated, refine with --set refinement.bundle.refine_focal_length=false";
  return line.str();
}

// A session's map, markers and survey, ready to be georeferenced.
class Georeferencing {
 public:
  // Throws as GeoreferenceSession does.
  Georeferencing(const GeoreferenceArguments& arguments,
                 const Settings& settings,
                 const SessionStore& store,
                 const MapDelta& snapshot,
                 Console* console)
      : survey_(ReadSurveyOf(arguments)),
        photos_(store.Photos()),
        camera_(CameraOf(snapshot, store.camera())),
        map_sequence_(snapshot.sequence),
        georeferencer_(settings.georeferencer, camera_) {
    if (snapshot.views_set.empty()) {
      throw std::runtime_error(WhyNothingIsLocated(store) + "; there is nothing to place");
    }
    Apply(snapshot);
    SetPositions(photos_, &georeferencer_);
    if (survey_) georeferencer_.SetSurvey(*survey_);
    if (!NeedsMarkers(survey_)) return;
    std::map<PhotoId, std::string> file_of_photo;
    for (const StoredPhoto& photo : photos_) file_of_photo[photo.id] = photo.name;
    FindMarkers(store.folder() + "/photos",
                camera_,
                WithOriginalNames(snapshot.views_set, photos_),
                file_of_photo,
                arguments.num_threads,
                &georeferencer_,
                console);
  }

  // As the map is now, under the number of the session's map.
  SessionGeoreference Compute() {
    SessionGeoreference result;
    result.survey = survey_;
    result.georeference = georeferencer_.Update();
    result.georeference.map_sequence = map_sequence_;
    result.sightings = georeferencer_.Sightings();
    return result;
  }

  // Refines `map`, of which Compute has told, and gives what changed.
  MapDelta Refine(const RefinementOptions& options, Map* map, Console* console) {
    const MapRefinement refinement = RefineMap(options, camera_, georeferencer_.Constraints(), map);
    const std::optional<MapDelta> delta = map->TakeDelta();
    if (!refinement.is_usable || !delta) {
      throw std::runtime_error(
          "the bundle found no better map, or a lens that no camera has; hold the lens with --set "
          "refinement.bundle.refine_distortion=false, or leave --refine out");
    }
    console->PrintLine(SummaryOf(refinement, camera_));
    const std::string warning = LensWarning(refinement, camera_);
    if (!warning.empty()) console->PrintLine(warning);
    Apply(*delta);
    return *delta;
  }

 private:
  void Apply(MapDelta delta) {
    delta.views_set = WithOriginalNames(delta.views_set, photos_);
    georeferencer_.Apply(delta);
  }

  std::optional<Survey> survey_;
  std::vector<StoredPhoto> photos_;
  Camera camera_;
  std::uint32_t map_sequence_;
  Georeferencer georeferencer_;
};

// Throws std::runtime_error if there is no georeference, or none that can be used.
void CheckIsUsable(const GeoreferenceArguments& arguments, const Georeference& georeference) {
  const std::string errors = JoinedErrors(georeference);
  if (!errors.empty()) throw std::runtime_error(errors);
  if (georeference.source != GeoreferenceSource::kNone) return;
  throw std::runtime_error(arguments.session +
                           ": no survey was given, and the photos' GPS does not place the model: "
                           "that needs three located photos with position and height, not in a "
                           "line; give --survey");
}

void PrintLines(const Georeference& georeference, Console* console) {
  for (const std::string& line : Describe(georeference)) console->PrintLine(line);
}

void WriteFiles(const GeoreferenceArguments& arguments,
                const SessionGeoreference& result,
                Console* console) {
  const std::string path = GeoreferencePath(arguments.session);
  std::filesystem::create_directories(std::filesystem::path(path).parent_path());
  nlohmann::ordered_json json = ToJson(result.georeference);
  json["refined"] = arguments.refine;
  WriteFileAtomically(path,
                      json.dump(2, ' ', false, nlohmann::json::error_handler_t::replace) + '\n');
  console->PrintLine("wrote " + path);
  ExportFolder files(arguments.session + "/export");
  std::vector<std::string> stale;
  const bool has_gcp_list =
      result.georeference.source == GeoreferenceSource::kTargets && result.survey->crs != kLocalCrs;
  if (has_gcp_list) {
    const std::string gcp_path = arguments.session + "/export/" + kGcpList;
    WriteFileAtomically(gcp_path, ToGcpList(*result.survey, result.sightings));
    files.Add({kGcpList}, /*state=*/"");
    console->PrintLine("wrote " + gcp_path);
  } else {
    stale = files.Delete({kGcpList});
  }
  for (std::string& line :
       files.DeleteStale(ExportState(result.georeference.map_sequence, arguments.refine, path))) {
    stale.push_back(std::move(line));
  }
  for (const std::string& line : stale) console->PrintLine(line);
  if (!stale.empty()) console->PrintLine("plumbline export and plumbline mesh write them anew");
}

}  // namespace

std::string GeoreferencePath(const std::string& session) {
  return session + "/export/georeference.json";
}

SessionGeoreference GeoreferenceSession(const GeoreferenceArguments& arguments,
                                        const SessionStore& store,
                                        const MapDelta& snapshot,
                                        Console* console) {
  const Settings settings = ReadSettings(arguments.settings);
  return Georeferencing(arguments, settings, store, snapshot, console).Compute();
}

void WriteSessionGeoreference(const GeoreferenceArguments& arguments, Console* console) {
  const Settings settings = ReadSettings(arguments.settings);
  std::optional<SessionStore> store = SessionStore::OpenExisting(arguments.session);
  const std::string exports = arguments.session + "/export";  // Made at the end, if need be.
  RequireWritable(std::filesystem::exists(exports) ? GeoreferencePath(arguments.session) : exports);
  const bool had_refinement = store->HasRefinement();
  if (arguments.refine || had_refinement) {  // They are to be written.
    store.emplace(SessionStore(arguments.session, store->camera()));
  }
  Georeferencing georeferencing(arguments, settings, *store, store->Snapshot(), console);
  SessionGeoreference result = georeferencing.Compute();
  PrintLines(result.georeference, console);
  CheckIsUsable(arguments, result.georeference);
  if (arguments.refine) {
    Map map = ReadStoredMap(*store);
    const MapDelta delta = georeferencing.Refine(settings.refinement, &map, console);
    result = georeferencing.Compute();
    PrintLines(result.georeference, console);
    CheckIsUsable(arguments, result.georeference);
    store->SaveRefinement(delta);
  } else if (had_refinement) {
    store->DropRefinement();
    console->PrintLine("the refinement there was is dropped; --refine makes it anew");
  }
  WriteFiles(arguments, result, console);
}

}  // namespace plumb::tools

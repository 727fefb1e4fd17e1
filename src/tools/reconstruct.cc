// SPDX-FileCopyrightText: 2026 The Plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "tools/reconstruct.h"

#include <filesystem>
#include <future>
#include <iomanip>
#include <map>
#include <memory>
#include <sstream>
#include <utility>

#include "plumbline/camera/camera.h"
#include "plumbline/common/atomic_file.h"
#include "plumbline/common/stopwatch.h"
#include "plumbline/map/run_report.h"
#include "plumbline/map/session_store.h"
#include "plumbline/sfm/mapper.h"
#include "plumbline/sfm/stored_session.h"
#include "tools/count_text.h"
#include "tools/export_session.h"
#include "tools/options_yaml.h"
#include "tools/photo_list.h"
#include "tools/photo_reader.h"
#include "tools/session_map.h"
#include "tools/session_recorder.h"

namespace plumb::tools {
namespace {

namespace fs = std::filesystem;

fs::path Resolved(const std::string& folder) {
  const fs::path path = fs::weakly_canonical(folder);
  return path.has_filename() ? path : path.parent_path();
}

// The session keeps files of its own, and copies of the photos in photos/: neither may be taken for
// the folder of the originals.
void CheckFoldersAreApart(const ReconstructArguments& arguments) {
  const fs::path session = Resolved(arguments.session);
  fs::path folder = Resolved(arguments.photos);
  if (folder == session) {
    throw std::runtime_error("--session " + arguments.session +
                             ": is the folder of the photos; name a folder of its own, new or one "
                             "to go on with");
  }
  for (; folder != folder.parent_path(); folder = folder.parent_path()) {
    if (folder != session) continue;
    throw std::runtime_error("--photos " + arguments.photos + ": lies inside the session " +
                             arguments.session +
                             "; name the folder the photos came from, or another session");
  }
}

std::vector<PhotoTask> FolderTasks(const ReconstructArguments& arguments, Console* console) {
  PhotoListing listing = ListPhotos(arguments.photos);
  ApplyOrder(arguments.order, &listing.photos);
  for (const std::string& line : Describe(listing)) console->PrintLine(line);
  std::vector<PhotoTask> tasks;
  for (const std::string& name : listing.photos) {
    tasks.push_back({arguments.photos + '/' + name, name, std::nullopt});
  }
  return tasks;
}

std::vector<PhotoTask> UnfinishedTasks(const std::vector<StoredPhoto>& unfinished,
                                       SessionStore* store) {
  std::vector<PhotoTask> tasks;
  for (const StoredPhoto& photo : unfinished) {
    tasks.push_back({store->photos().PathOf(photo.name), photo.source_name, photo.id});
  }
  return tasks;
}

// Whether the session's report tells that a run with these options has completed this very map.
bool IsCompleted(const SessionStore& store,
                 const StoredSession& session,
                 const MapperOptions& options) {
  try {
    const std::vector<std::uint8_t> bytes = ReadFileBytes(store.folder() + "/report.json");
    const auto report = nlohmann::ordered_json::parse(bytes.begin(), bytes.end());
    const nlohmann::ordered_json& counts = report.at("session");
    return session.unfinished.empty() && report.at("run").at("interrupted") == false &&
           counts.at("photos") == session.photos.size() &&
           counts.at("accepted") == session.snapshot.views_set.size() &&
           counts.at("landmarks") == session.snapshot.landmarks_set.size() &&
           counts.at("observations") == session.snapshot.observations_added.size() &&
           report.at("options") == OptionsToJson(options);
  } catch (const std::runtime_error&) {  // It is not there.
    return false;
  } catch (const nlohmann::json::exception&) {  // It was cut off or changed.
    return false;
  }
}

// Feeds photos to a mapper while the next one is being read and analysed.
class Feeder {
 public:
  Feeder(const MapperOptions& options, const Camera& camera, SessionStore* store, Console* console)
      : console_(console),
        known_(store),
        reader_(options.features, camera.width_px(), camera.height_px(), &store->photos(), &known_),
        next_id_(store->NextPhotoId()),
        recorder_(store, [this](const PhotoVerdict& verdict) { Show(verdict); }),
        mapper_(options, camera, &recorder_) {}

  void Restore(StoredSession session) {
    mapper_.Restore(std::move(session.photos), session.verdicts, session.snapshot);
  }

  // False if it was stopped. A map that is completed already stays as it is if nothing is new.
  bool Feed(const std::vector<PhotoTask>& tasks, bool is_completed, const std::atomic<bool>& stop) {
    std::future<ReadPhoto> next = reader_.Start(tasks[0]);
    Stopwatch turn;
    double cpu_s = CurrentProcessUsage().cpu_s;
    for (std::size_t i = 0; i < tasks.size(); ++i) {
      num_left_ = tasks.size() - i;
      if (stop) return false;
      ReadPhoto photo = next.get();
      if (i + 1 < tasks.size()) next = reader_.Start(tasks[i + 1]);
      console_->ShowProgress(i, tasks.size(), tasks[i].source_name);
      if (photo.known_as) {
        if (turns_.count(*photo.known_as) == 0) ++num_known_;
        continue;
      }
      if (!photo.trouble.empty() && !photo.task.stored_id) {
        unread_.push_back(photo.trouble);
        console_->PrintLine(photo.task.source_name + ": not taken: " + photo.trouble);
        continue;
      }
      const PhotoId id = Add(std::move(photo));
      const double cpu_before_s = std::exchange(cpu_s, CurrentProcessUsage().cpu_s);
      turns_[id] = {turn.Restart(), cpu_s - cpu_before_s};
    }
    num_left_ = 0;
    if (turns_.empty() && is_completed) return true;
    console_->ShowProgress(tasks.size(), tasks.size(), "last bundle");
    mapper_.Finish();
    return true;
  }

  void Close() { recorder_.Close(); }

  std::size_t num_left() const { return num_left_; }
  std::size_t num_known() const { return num_known_; }
  const std::vector<std::string>& unread() const { return unread_; }
  const std::map<PhotoId, PhotoTurn>& turns() const { return turns_; }
  const Map& map() const { return mapper_.map(); }

 private:
  PhotoId Add(ReadPhoto photo) {
    const PhotoId id = photo.task.stored_id.value_or(next_id_);
    if (id == next_id_) ++next_id_.value;
    const Timestamp exposure_time = photo.analysis.metadata.exposure_time.value_or(Timestamp{});
    recorder_.SavePhoto(id, photo, exposure_time);
    mapper_.Add({id,
                 photo.name,
                 exposure_time,
                 std::move(photo.analysis),
                 photo.since_first_byte.Seconds()});
    return id;
  }

  void Show(const PhotoVerdict& verdict) { console_->PrintLine(Describe(verdict)); }

  Console* console_;
  KnownPhotos known_;
  PhotoReader reader_;
  PhotoId next_id_;
  std::map<PhotoId, PhotoTurn> turns_;
  std::size_t num_left_ = 0;   // Not yet looked at.
  std::size_t num_known_ = 0;  // Files that the session had answered before this run.
  std::vector<std::string> unread_;
  SessionRecorder recorder_;
  Mapper mapper_;
};

std::string Summary(const RunReport& report) {
  const nlohmann::ordered_json json = ToJson(report);
  std::ostringstream text;
  text << std::fixed << std::setprecision(1) << json["session"]["accepted"] << " of "
       << json["session"]["photos"] << " photos located, " << report.num_landmarks << " landmarks; "
       << report.wall_s << " s, " << report.usage.cpu_s << " s of CPU, "
       << static_cast<double>(report.usage.peak_memory_bytes) / 1048576.0 << " MiB";
  return text.str();
}

// export/ and report.json, with the figures of the whole run.
void WriteResults(const SessionStore& store,
                  const Stopwatch& wall,
                  RunReport* report,
                  Console* console) {
  const ExportedSession exported =
      ExportSession(store, ReadSessionMap(store), store.folder() + "/export");
  for (const std::string& line : exported.lines) console->PrintLine(line);
  report->wall_s = wall.Seconds();
  report->usage = CurrentProcessUsage();
  const std::string path = store.folder() + "/report.json";
  WriteRunReport(*report, path);
  console->PrintLine("wrote " + path);
  console->PrintLine(Summary(*report));
  if (!exported.lacks.empty()) console->PrintLine(exported.lacks);
}

}  // namespace

// The file may have the mapper node's group around the options, as config/mapper.yaml does.
MapperOptions ReadMapperOptions(const ReconstructArguments& arguments) {
  MapperOptions options;
  std::string source = "the default options";
  if (!arguments.options.empty()) {
    source = arguments.options;
    const std::vector<std::uint8_t> bytes = ReadFileBytes(source);
    const YAML::Node root = ParseYaml({bytes.begin(), bytes.end()}, source);
    const bool is_of_node = root.IsMap() && root.size() == 1 && root["mapper"].IsDefined();
    ReadValue(is_of_node ? root["mapper"] : root, {source, ""}, &options);
  }
  for (const std::string& setting : arguments.settings) {
    source = "--set " + setting;
    ReadValue(ParseSetting(setting), {source, ""}, &options);
  }
  std::string problems;
  for (const std::string& problem : options.Problems()) {
    problems += (problems.empty() ? "" : "; ") + problem;
  }
  if (!problems.empty()) throw std::runtime_error(source + ": " + problems);
  return options;
}

ExitCode Reconstruct(const ReconstructArguments& arguments,
                     const std::atomic<bool>& stop,
                     Console* console) {
  const Stopwatch wall;
  // All that can be wrong with the arguments, before a session is made.
  const Camera camera = ReadCameraYaml(arguments.camera);
  const MapperOptions options = ReadMapperOptions(arguments);
  CheckFoldersAreApart(arguments);
  const std::vector<PhotoTask> folder_tasks = FolderTasks(arguments, console);

  SessionStore store(arguments.session, camera);
  StoredSession session = ReadStoredSession(store);
  std::vector<PhotoTask> tasks = UnfinishedTasks(session.unfinished, &store);
  tasks.insert(tasks.end(), folder_tasks.begin(), folder_tasks.end());
  const bool is_completed = IsCompleted(store, session, options);
  Feeder feeder(options, camera, &store, console);
  if (!session.photos.empty()) {
    console->PrintLine(arguments.session + ": going on after " +
                       CountOf(session.photos.size(), "photo"));
    feeder.Restore(std::move(session));
  }
  const bool is_complete = feeder.Feed(tasks, is_completed, stop);
  feeder.Close();
  if (feeder.num_known() > 0) {
    console->PrintLine(CountOf(feeder.num_known(), "file") + " in the session already");
  }
  if (!feeder.unread().empty()) {
    console->PrintLine(CountOf(feeder.unread().size(), "file") +
                       " could not be read, see above; run again once that is mended");
  }

  const ExitCode exit_code = feeder.map().views().empty() ? kNothingLocated : kDone;
  if (is_complete && is_completed && feeder.turns().empty()) {
    console->PrintLine("nothing new: map, export and report stay as they are");
    return exit_code;
  }

  RunReport report;
  report.verdicts = store.AllVerdicts();
  report.turns = feeder.turns();
  report.unread = feeder.unread();
  report.num_landmarks = feeder.map().num_landmarks();
  report.num_observations = feeder.map().num_observations();
  report.interrupted = !is_complete;
  report.options = OptionsToJson(options);
  WriteResults(store, wall, &report, console);
  if (!is_complete) {
    console->PrintLine("interrupted: " + std::to_string(feeder.num_left()) + " of " +
                       CountOf(tasks.size(), "photo") +
                       " not yet looked at; the same command goes on");
    return kInterrupted;
  }
  return exit_code;
}

}  // namespace plumb::tools

// SPDX-FileCopyrightText: 2026 The Plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "tools/reconstruct.h"

#include <future>
#include <iomanip>
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
#include "tools/export_session.h"
#include "tools/options_yaml.h"
#include "tools/photo_list.h"
#include "tools/photo_reader.h"
#include "tools/session_recorder.h"

namespace plumb::tools {
namespace {

// The unfinished photos of the session, then the files of the folder.
std::vector<PhotoTask> MakeTasks(const ReconstructArguments& arguments,
                                 const std::vector<StoredPhoto>& unfinished,
                                 SessionStore* store) {
  std::vector<PhotoTask> tasks;
  for (const StoredPhoto& photo : unfinished) {
    tasks.push_back({store->photos().PathOf(photo.name), photo.source_name, photo.id});
  }
  std::vector<std::string> names = ListPhotos(arguments.photos);
  ApplyOrder(arguments.order, &names);
  for (const std::string& name : names) {
    tasks.push_back({arguments.photos + '/' + name, name, std::nullopt});
  }
  return tasks;
}

// Feeds photos to a mapper while the next one is being read and analysed.
class Feeder {
 public:
  Feeder(const MapperOptions& options, const Camera& camera, SessionStore* store, Console* console)
      : store_(store),
        console_(console),
        known_(store),
        reader_(options.features, camera.width_px(), camera.height_px(), &store->photos(), &known_),
        next_id_(store->NextPhotoId()),
        recorder_(store, [this](const PhotoVerdict& verdict) { Show(verdict); }),
        mapper_(options, camera, &recorder_) {}

  void Restore(StoredSession session) {
    num_restored_ = session.photos.size();
    mapper_.Restore(std::move(session.photos), session.verdicts, session.snapshot);
  }

  // False if it was stopped.
  bool Feed(const std::vector<PhotoTask>& tasks, const std::atomic<bool>& stop) {
    std::future<ReadPhoto> next = reader_.Start(tasks[0]);
    for (std::size_t i = 0; i < tasks.size(); ++i) {
      if (stop) return false;
      ReadPhoto photo = next.get();
      if (i + 1 < tasks.size()) next = reader_.Start(tasks[i + 1]);
      console_->ShowProgress(i, tasks.size(), tasks[i].source_name);
      if (!photo.is_known) Add(std::move(photo));
    }
    console_->ShowProgress(tasks.size(), tasks.size(), "last bundle");
    mapper_.Finish();
    return true;
  }

  void Close() { recorder_.Close(); }

  std::size_t num_added() const { return num_added_; }
  std::size_t num_restored() const { return num_restored_; }
  const Map& map() const { return mapper_.map(); }

 private:
  void Add(ReadPhoto photo) {
    const PhotoId id = photo.task.stored_id.value_or(next_id_);
    if (id == next_id_) ++next_id_.value;
    const Timestamp exposure_time = photo.analysis.metadata.exposure_time.value_or(Timestamp{});
    recorder_.SavePhoto(id, photo, exposure_time);
    ++num_added_;
    mapper_.Add({id,
                 photo.name,
                 exposure_time,
                 std::move(photo.analysis),
                 photo.since_first_byte.Seconds()});
  }

  void Show(const PhotoVerdict& verdict) { console_->PrintLine(Describe(verdict)); }

  SessionStore* store_;
  Console* console_;
  KnownPhotos known_;
  PhotoReader reader_;
  PhotoId next_id_;
  std::size_t num_added_ = 0;
  std::size_t num_restored_ = 0;
  SessionRecorder recorder_;
  Mapper mapper_;
};

std::string Summary(const RunReport& report, const nlohmann::ordered_json& json) {
  std::ostringstream text;
  text << std::fixed << std::setprecision(1) << json["session"]["accepted"] << " of "
       << json["session"]["photos"] << " photos located, " << report.num_landmarks << " landmarks; "
       << report.wall_s << " s, " << report.usage.cpu_s << " s of CPU, "
       << static_cast<double>(report.usage.peak_memory_bytes) / 1048576.0 << " MiB";
  return text.str();
}

}  // namespace

MapperOptions ReadMapperOptions(const ReconstructArguments& arguments) {
  MapperOptions options;
  std::string source = "the default options";
  if (!arguments.options.empty()) {
    source = arguments.options;
    const std::vector<std::uint8_t> bytes = ReadFileBytes(source);
    ReadValue(ParseYaml({bytes.begin(), bytes.end()}, source), {source, ""}, &options);
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
  const Camera camera = ReadCameraYaml(arguments.camera);
  const MapperOptions options = ReadMapperOptions(arguments);
  SessionStore store(arguments.session, camera);
  StoredSession session = ReadStoredSession(store);
  const std::vector<PhotoTask> tasks = MakeTasks(arguments, session.unfinished, &store);
  Feeder feeder(options, camera, &store, console);
  if (!session.photos.empty()) {
    console->PrintLine(arguments.session + ": going on after " +
                       std::to_string(session.photos.size()) + " photos");
    feeder.Restore(std::move(session));
  }
  const bool is_complete = feeder.Feed(tasks, stop);
  feeder.Close();
  const std::size_t num_known = tasks.size() - feeder.num_added();
  if (is_complete && num_known > 0) {
    console->PrintLine(std::to_string(num_known) + " files were in the session already");
  }
  for (const std::string& path : ExportSession(store, arguments.session + "/export")) {
    console->PrintLine("wrote " + path);
  }
  RunReport report;
  report.verdicts = store.AllVerdicts();
  report.num_landmarks = feeder.map().num_landmarks();
  report.num_observations = feeder.map().num_observations();
  report.wall_s = wall.Seconds();
  report.usage = CurrentProcessUsage();
  report.interrupted = !is_complete;
  report.options = OptionsToJson(options);
  const std::string report_path = arguments.session + "/report.json";
  WriteRunReport(report, report_path);
  console->PrintLine("wrote " + report_path);
  console->PrintLine(Summary(report, ToJson(report)));
  if (!is_complete) return kInterrupted;
  return feeder.map().views().empty() ? kNothingLocated : kDone;
}

}  // namespace plumb::tools

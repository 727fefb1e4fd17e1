// SPDX-FileCopyrightText: 2026 The Plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <atomic>
#include <chrono>
#include <cstdint>
#include <exception>
#include <functional>
#include <future>
#include <map>
#include <memory>
#include <mutex>
#include <optional>
#include <set>
#include <string>
#include <variant>
#include <vector>

#include "plumbline/camera/camera.h"
#include "plumbline/common/stage.h"
#include "plumbline/map/run_report.h"
#include "plumbline/map/session_store.h"
#include "plumbline/sfm/mapper.h"
#include "plumbline/sfm/stored_session.h"
#include "ros/photo_conversion.h"

namespace plumb::ros_adapter {

using PhotoBytes = std::shared_ptr<const std::vector<std::uint8_t>>;

// What a LiveMapper tells, each from a thread of its own choice.
struct LiveMapperOutput {
  // At once; `bytes` is the photo, or null where the verdict is that of an earlier one.
  std::function<void(const PhotoVerdict& verdict, const PhotoBytes& bytes)> on_verdict;
  // In order of number. After a restart the stored map comes first, as a snapshot.
  std::function<void(const MapDelta& delta)> on_map_delta;
  // The photos whose verdict is on disk, ascending; at the start and after each write.
  std::function<void(const std::vector<std::uint32_t>& sequences)> on_stored;
  // What keeps the session from being written, at each try, and how many verdicts wait for that;
  // empty once all of it is written.
  std::function<void(const std::string& trouble, std::size_t num_waiting)> on_storage_trouble;
};

// Runs a Mapper in a flight: one thread finds the features of the photos to come, one maps, one
// writes the session, each ahead of a bounded queue, so that a verdict waits for neither
// disk nor listener. Goes on with the session it finds. Thread-safe.
class LiveMapper {
 public:
  // Throws std::runtime_error naming the file if the session cannot be opened or is another
  // camera's. `output` is called until the destructor returns.
  LiveMapper(const MapperOptions& options,
             const std::string& session_folder,
             const Camera& camera,
             int max_queue,
             LiveMapperOutput output);
  ~LiveMapper();

  const Camera& camera() const { return camera_; }

  // The latest verdict of each photo, without pixels; at first those of the session as found.
  std::map<PhotoId, PhotoVerdict> verdicts() const;

  // Takes a photo; its verdict follows. A photo that has one gets it again. False if the
  // queue is full: offer it again later.
  bool Offer(WirePhoto photo);

  // Mapper::SetConstraints before the next photo, or the next Poll. Returns at once.
  void SetConstraints(BundleConstraints constraints);

  // Lets the mapper look at what its background has found, if it has nothing else to do.
  void Poll();

  // Mapper::Finish after the photos offered so far, then SESSION/report.json. Empty once all is on
  // disk; else, as soon as something lasting keeps it from that, what it is and the cure. A session
  // that is not written is completed all the same once it can be.
  std::string Finish();

  // Throws what stopped a thread, if anything did: the mapper is of no use then.
  void RethrowFailure();

  StageCounters analysis_counters() const { return analysis_->counters(); }
  StageCounters mapping_counters() const { return mapping_->counters(); }
  StageCounters storage_counters() const { return storage_->counters(); }

 private:
  using Clock = std::chrono::steady_clock;

  struct ArrivedPhoto {
    WirePhoto photo;
    PhotoBytes bytes;
    Clock::time_point offered;
  };
  struct AnalyzedPhoto {
    ArrivedPhoto arrived;
    PhotoAnalysis analysis;
  };
  struct PollRequest {};
  using FinishRequest = std::shared_ptr<std::promise<void>>;
  using AnalysisItem = std::variant<ArrivedPhoto, FinishRequest>;
  using MappingItem = std::variant<AnalyzedPhoto, PollRequest, FinishRequest>;
  using StorageItem = std::function<void(SessionStore&)>;

  class Listener;

  StoredSession ReadSession();
  void Analyze(AnalysisItem item);
  void Map(MappingItem item);
  void TakeConstraints();
  void MapPhoto(AnalyzedPhoto photo);
  RunReport MakeReport() const;
  void Store(const StorageItem& item);
  void NoteStorageTrouble(const std::string& trouble);
  std::string LastingTrouble() const;
  void StorePhoto(const AnalyzedPhoto& photo);
  void TellStored() const;
  void NoteFailure();

  const Clock::time_point started_ = Clock::now();
  MapperOptions options_;
  Camera camera_;
  LiveMapperOutput output_;
  SessionStore store_;  // Of the storage thread, once it runs.
  std::set<PhotoId> stored_photos_;
  std::set<std::uint32_t> stored_verdicts_;
  bool has_told_trouble_ = false;

  mutable std::mutex mutex_;  // Of what follows.
  std::set<PhotoId> in_work_;
  std::map<PhotoId, PhotoVerdict> verdicts_;
  std::exception_ptr failure_;
  std::optional<BundleConstraints> new_constraints_;  // That the mapper has not got yet.
  std::string storage_trouble_;                       // Of the item that is being written.
  Clock::time_point trouble_since_;

  std::atomic<bool> is_stopping_{false};

  // Of the mapping thread.
  std::unique_ptr<Listener> listener_;
  std::unique_ptr<Mapper> mapper_;
  PhotoId current_photo_;
  PhotoBytes current_bytes_;

  // In the order of their ends: a stage must outlive the one that feeds it.
  std::unique_ptr<Stage<StorageItem>> storage_;
  std::unique_ptr<Stage<MappingItem>> mapping_;
  std::unique_ptr<Stage<AnalysisItem>> analysis_;
};

}  // namespace plumb::ros_adapter

// SPDX-FileCopyrightText: 2026 The Plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "ros/live_mapper.h"

#include <algorithm>
#include <stdexcept>
#include <thread>
#include <utility>

#include "plumbline/image/photo_analysis.h"

namespace plumb::ros_adapter {
namespace {

// Deltas, verdicts and seconds of some fifty photos; beyond them mapping waits for the disk.
constexpr std::size_t kMaxStorageQueue = 256;

// One photo is mapped while the next is ready.
constexpr std::size_t kMaxMappingQueue = 2;

constexpr std::chrono::milliseconds kStorageRetryEvery{1000};

// What three tries did not write is not written soon.
constexpr std::chrono::milliseconds kLasting{2500};

constexpr std::chrono::milliseconds kFinishPollEvery{50};

double SecondsSince(std::chrono::steady_clock::time_point begin) {
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
}

// Clocks may step between the two; nothing is older than it can be.
double AgeAtPublishing_s(const WirePhoto& photo) {
  return std::max(0.0, static_cast<double>(photo.published.ns - photo.received.ns) * 1e-9);
}

}  // namespace

// Hears the mapper, in the mapping thread.
class LiveMapper::Listener : public MapperListener {
 public:
  explicit Listener(LiveMapper* live) : live_(live) {}

  void OnVerdict(const PhotoVerdict& verdict) override {
    const bool is_current = verdict.photo == live_->current_photo_;
    {
      const std::lock_guard<std::mutex> lock(live_->mutex_);
      PhotoVerdict kept = verdict;
      kept.inlier_pixels.clear();
      kept.outlier_pixels.clear();
      live_->verdicts_[verdict.photo] = std::move(kept);
      live_->in_work_.erase(verdict.photo);
    }
    live_->output_.on_verdict(verdict, is_current ? live_->current_bytes_ : nullptr);
    live_->storage_->Push([live = live_, verdict](SessionStore& store) {
      store.SaveVerdict(verdict);
      live->stored_verdicts_.insert(verdict.photo.value);
      live->TellStored();
    });
  }

  void OnMapDelta(const MapDelta& delta) override {
    live_->output_.on_map_delta(delta);
    live_->storage_->Push([delta](SessionStore& store) { store.Apply(delta); });
  }

  void OnSeconds(PhotoId photo, const StageSeconds& seconds) override {
    live_->storage_->Push(
        [photo, seconds](SessionStore& store) { store.SaveSeconds(photo, seconds); });
  }

 private:
  LiveMapper* live_;
};

LiveMapper::LiveMapper(const MapperOptions& options,
                       const std::string& session_folder,
                       const Camera& camera,
                       int max_queue,
                       LiveMapperOutput output)
    : options_(options),
      camera_(camera),
      output_(std::move(output)),
      store_(session_folder, camera),
      listener_(std::make_unique<Listener>(this)),
      mapper_(std::make_unique<Mapper>(options, camera, listener_.get())) {
  StoredSession session = ReadSession();
  storage_ = std::make_unique<Stage<StorageItem>>(kMaxStorageQueue,
                                                  [this](const StorageItem& item) { Store(item); });
  mapping_ = std::make_unique<Stage<MappingItem>>(
      kMaxMappingQueue, [this](MappingItem item) { Map(std::move(item)); });
  analysis_ = std::make_unique<Stage<AnalysisItem>>(
      static_cast<std::size_t>(max_queue), [this](AnalysisItem item) { Analyze(std::move(item)); });
  TellStored();
  if (session.photos.empty()) return;
  output_.on_map_delta(session.snapshot);
  mapper_->Restore(std::move(session.photos), session.verdicts, session.snapshot);
}

LiveMapper::~LiveMapper() { is_stopping_ = true; }

StoredSession LiveMapper::ReadSession() {
  StoredSession session = ReadStoredSession(store_);
  for (const PhotoVerdict& verdict : session.verdicts) {
    verdicts_[verdict.photo] = verdict;
    stored_verdicts_.insert(verdict.photo.value);
  }
  for (const MapperPhoto& photo : session.photos) stored_photos_.insert(photo.id);
  for (const StoredPhoto& photo : session.unfinished) stored_photos_.insert(photo.id);
  return session;
}

bool LiveMapper::Offer(WirePhoto photo) {
  const PhotoId id = photo.id;
  std::optional<PhotoVerdict> known;
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    const auto it = verdicts_.find(id);
    if (it != verdicts_.end()) {
      known = it->second;
    } else if (!in_work_.insert(id).second) {
      return true;
    }
  }
  if (known) {
    output_.on_verdict(*known, nullptr);
    return true;
  }
  auto bytes = std::make_shared<const std::vector<std::uint8_t>>(std::move(photo.bytes));
  photo.bytes.clear();
  if (analysis_->TryPush(ArrivedPhoto{std::move(photo), std::move(bytes), Clock::now()})) {
    return true;
  }
  const std::lock_guard<std::mutex> lock(mutex_);
  in_work_.erase(id);
  return false;
}

std::map<PhotoId, PhotoVerdict> LiveMapper::verdicts() const {
  const std::lock_guard<std::mutex> lock(mutex_);
  return verdicts_;
}

void LiveMapper::SetConstraints(BundleConstraints constraints) {
  const std::lock_guard<std::mutex> lock(mutex_);
  new_constraints_ = std::move(constraints);
}

void LiveMapper::TakeConstraints() {
  std::optional<BundleConstraints> constraints;
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    constraints = std::exchange(new_constraints_, std::nullopt);
  }
  if (constraints) mapper_->SetConstraints(std::move(*constraints));
}

void LiveMapper::Poll() {
  if (mapping_->counters().queue_depth == 0) mapping_->TryPush(PollRequest());
}

std::string LiveMapper::Finish() {
  auto done = std::make_shared<std::promise<void>>();
  std::future<void> future = done->get_future();
  while (future.wait_for(kFinishPollEvery) != std::future_status::ready) {
    const std::string trouble = LastingTrouble();
    if (!trouble.empty()) return trouble;
    if (done && analysis_->TryPush(done)) done.reset();  // Now the stages hold it alone.
  }
  try {
    future.get();
    return {};
  } catch (const std::future_error&) {  // A stage threw the request away.
    const std::string trouble = LastingTrouble();
    return trouble.empty() ? "the mapper has ended" : trouble;
  }
}

// Of the mapper, or of a session that was not written for a while.
std::string LiveMapper::LastingTrouble() const {
  const std::lock_guard<std::mutex> lock(mutex_);
  try {
    if (failure_) std::rethrow_exception(failure_);
  } catch (const std::exception& error) {
    return std::string("the mapper has failed and is started again: ") + error.what();
  }
  if (storage_trouble_.empty() || Clock::now() - trouble_since_ < kLasting) return {};
  return storage_trouble_;
}

void LiveMapper::RethrowFailure() {
  const std::lock_guard<std::mutex> lock(mutex_);
  if (failure_) std::rethrow_exception(failure_);
}

void LiveMapper::Analyze(AnalysisItem item) {
  if (auto* request = std::get_if<FinishRequest>(&item)) {
    mapping_->Push(std::move(*request));
    return;
  }
  if (is_stopping_) return;  // Without a verdict it comes again.
  auto& arrived = std::get<ArrivedPhoto>(item);
  PhotoAnalysis analysis =
      AnalyzePhoto(options_.features, *arrived.bytes, camera_.width_px(), camera_.height_px());
  mapping_->Push(AnalyzedPhoto{std::move(arrived), std::move(analysis)});
}

void LiveMapper::Map(MappingItem item) {
  try {
    TakeConstraints();
    if (auto* photo = std::get_if<AnalyzedPhoto>(&item)) {
      MapPhoto(std::move(*photo));
    } else if (auto* request = std::get_if<FinishRequest>(&item)) {
      mapper_->Finish();
      storage_->Push([this, report = MakeReport(), done = *request](SessionStore& store) mutable {
        report.verdicts = store.AllVerdicts();
        WriteRunReport(report, store.folder() + "/report.json");
        done->set_value();
      });
    } else {
      mapper_->Poll();
    }
  } catch (...) {
    NoteFailure();
    throw;
  }
}

RunReport LiveMapper::MakeReport() const {
  RunReport report;
  report.num_landmarks = mapper_->map().num_landmarks();
  report.num_observations = mapper_->map().num_observations();
  report.wall_s = SecondsSince(started_);
  report.usage = CurrentProcessUsage();
  report.options = OptionsToJson(options_);
  return report;
}

void LiveMapper::MapPhoto(AnalyzedPhoto photo) {
  current_photo_ = photo.arrived.photo.id;
  current_bytes_ = photo.arrived.bytes;
  const auto kept = std::make_shared<const AnalyzedPhoto>(photo);
  storage_->Push([this, kept](SessionStore&) { StorePhoto(*kept); });
  const WirePhoto& wire = photo.arrived.photo;
  mapper_->Add({wire.id,
                wire.name,
                wire.exposure_time,
                std::move(photo.analysis),
                AgeAtPublishing_s(wire) + SecondsSince(photo.arrived.offered)});
  current_bytes_.reset();
}

// A full disk must neither lose what is to be written nor stop the flight: tried until it works.
void LiveMapper::Store(const StorageItem& item) {
  while (true) {
    try {
      item(store_);
      NoteStorageTrouble("");
      return;
    } catch (const std::runtime_error& error) {
      NoteStorageTrouble(error.what());
    } catch (...) {
      NoteFailure();
      throw;
    }
    if (is_stopping_) return;
    std::this_thread::sleep_for(kStorageRetryEvery);
  }
}

void LiveMapper::NoteStorageTrouble(const std::string& trouble) {
  std::size_t num_waiting = 0;
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    if (storage_trouble_.empty()) trouble_since_ = Clock::now();
    storage_trouble_ = trouble;
    num_waiting = verdicts_.size() - stored_verdicts_.size();
  }
  const bool is_over = trouble.empty() && storage_->counters().queue_depth == 0;
  if (!trouble.empty() || (has_told_trouble_ && is_over)) {
    output_.on_storage_trouble(trouble, num_waiting);
    has_told_trouble_ = !trouble.empty();
  }
}

void LiveMapper::StorePhoto(const AnalyzedPhoto& photo) {
  const WirePhoto& wire = photo.arrived.photo;
  if (stored_photos_.count(wire.id) == 0) {
    store_.SavePhoto(wire.id, wire.name, *photo.arrived.bytes);
    stored_photos_.insert(wire.id);
  }
  store_.SaveAnalysis(wire.id, wire.exposure_time, photo.analysis);
}

void LiveMapper::TellStored() const {
  output_.on_stored({stored_verdicts_.begin(), stored_verdicts_.end()});
}

void LiveMapper::NoteFailure() {
  const std::lock_guard<std::mutex> lock(mutex_);
  failure_ = std::current_exception();
}

}  // namespace plumb::ros_adapter

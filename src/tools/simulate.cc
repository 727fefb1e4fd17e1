// SPDX-FileCopyrightText: 2026 The Plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "tools/simulate.h"

#include <algorithm>
#include <exception>
#include <filesystem>
#include <iomanip>
#include <mutex>
#include <set>
#include <sstream>
#include <stdexcept>
#include <thread>

#include "plumbline/common/atomic_file.h"
#include "plumbline/common/stopwatch.h"
#include "plumbline/simulation/photographer.h"
#include "tools/scenario_yaml.h"
#include "tools/simulated_folder.h"

namespace plumb::tools {
namespace {

namespace fs = std::filesystem;

// All photos in work together.
constexpr double kMemoryForPhotos_bytes = 2e9;
// A pixel's light, its 8 bits, its share of the file, and the renderer's own.
constexpr double kBytesPerPixel = 24.0;

std::string Seconds(double seconds) {
  std::ostringstream text;
  text << std::fixed << std::setprecision(seconds < 10.0 ? 1 : 0) << seconds << " s";
  return text.str();
}

std::vector<std::size_t> ChoosePhotos(const SimulateArguments& arguments,
                                      const std::vector<PlannedPhoto>& photos) {
  std::set<std::string> known;
  for (const PlannedPhoto& photo : photos) known.insert(photo.row);
  for (const std::string& row : arguments.rows) {
    if (known.count(row) > 0) continue;
    std::string text;
    for (const std::string& name : known) text += ' ' + (name.empty() ? "(unnamed)" : name);
    throw std::runtime_error("--rows: no leg of the scenario has row \"" + row +
                             "\"; there are:" + text);
  }
  const std::set<std::string> wanted(arguments.rows.begin(), arguments.rows.end());
  std::vector<std::size_t> idxs;
  for (std::size_t i = 0; i < photos.size(); ++i) {
    if (wanted.empty() || wanted.count(photos[i].row) > 0) idxs.push_back(i);
  }
  const auto limit = static_cast<std::size_t>(arguments.max_photos);
  if (limit > 0 && idxs.size() > limit) idxs.resize(limit);
  return idxs;
}

// Takes the photos that are not there yet, several at once: each on its own keeps all cores busy to
// the end, which tiles of one photo do not.
class PhotoSeries {
 public:
  PhotoSeries(const Photographer& photographer,
              std::vector<std::size_t> photo_idxs,
              std::string folder,
              const std::atomic<bool>& stop,
              Console* console)
      : photographer_(photographer),
        photo_idxs_(std::move(photo_idxs)),
        folder_(std::move(folder)),
        stop_(stop),
        console_(console) {}

  // Returns how many photos were taken anew; throws what the first failing photo threw.
  int Take(int num_threads) {
    const double photo_bytes =
        kBytesPerPixel * photographer_.camera().width_px() * photographer_.camera().height_px();
    const int most = std::max(1, static_cast<int>(kMemoryForPhotos_bytes / photo_bytes));
    const int num_workers = std::min({num_threads, most, static_cast<int>(photo_idxs_.size())});
    const int threads_each = std::max(1, num_threads / std::max(1, num_workers));
    std::vector<std::thread> workers;
    for (int i = 0; i < num_workers; ++i) {
      workers.emplace_back([this, threads_each] { Work(threads_each); });
    }
    for (std::thread& worker : workers) worker.join();
    if (error_) std::rethrow_exception(error_);
    return num_taken_;
  }

 private:
  void Work(int num_threads) {
    try {
      for (std::size_t i = next_++; i < photo_idxs_.size(); i = next_++) {
        if (stop_ || failed_) return;
        const std::size_t photo_idx = photo_idxs_[i];
        const std::string file = PhotoFile(folder_, photographer_.photos()[photo_idx]);
        const bool is_there = fs::exists(file);
        if (!is_there) {
          const std::vector<std::uint8_t> bytes = photographer_.Take(photo_idx, num_threads);
          WriteFileAtomically(file, bytes.data(), bytes.size());
        }
        Report(is_there);
      }
    } catch (const std::exception&) {
      const std::lock_guard<std::mutex> lock(mutex_);
      if (!error_) error_ = std::current_exception();
      failed_ = true;
    }
  }

  void Report(bool was_there) {
    const std::lock_guard<std::mutex> lock(mutex_);
    ++num_done_;
    if (!was_there) ++num_taken_;
    std::string note;
    if (num_taken_ > 0) {
      const auto num_left = static_cast<double>(photo_idxs_.size() - num_done_);
      note = "photos, " + Seconds(num_left * stopwatch_.Seconds() / num_taken_) + " left";
    }
    console_->ShowProgress(num_done_, photo_idxs_.size(), note);
    const std::size_t num_tenths = 10 * num_done_ / photo_idxs_.size();
    if (console_->is_terminal() || num_tenths == num_tenths_) return;
    num_tenths_ = num_tenths;
    console_->PrintLine(std::to_string(num_done_) + " of " + std::to_string(photo_idxs_.size()) +
                        ' ' + (note.empty() ? "photos" : note));
  }

  const Photographer& photographer_;
  std::vector<std::size_t> photo_idxs_;
  std::string folder_;
  const std::atomic<bool>& stop_;
  Console* console_;
  Stopwatch stopwatch_;
  std::atomic<std::size_t> next_{0};
  std::atomic<bool> failed_{false};
  std::mutex mutex_;  // Guards what follows, and the console.
  std::size_t num_done_ = 0;
  int num_taken_ = 0;
  std::size_t num_tenths_ = 0;  // That were told; where there is no bar, a line says each.
  std::exception_ptr error_;
};

void WriteBag(const Photographer& photographer,
              const std::vector<std::size_t>& photo_idxs,
              const std::string& folder,
              const FlightBagWriter& write_bag) {
  std::vector<RecordedPhoto> photos;
  for (const std::size_t idx : photo_idxs) {
    const PlannedPhoto& photo = photographer.photos()[idx];
    photos.push_back({photo.name,
                      PhotoFile(folder, photo),
                      photo.exposure_time,
                      photographer.MeasuredPosition(idx)});
  }
  write_bag(folder + "/flight.bag", photographer.camera(), photos);
}

// Throws std::runtime_error naming the scenario's file and what is impossible in it.
Photographer MakePhotographer(const SimulateArguments& arguments) {
  const std::string file = FindScenario(arguments.scenario);
  Scenario scenario = ReadScenario(file);
  if (arguments.seed) scenario.seed = *arguments.seed;
  try {
    return Photographer(scenario);
  } catch (const std::invalid_argument& error) {
    throw std::runtime_error(file + ": " + error.what());
  }
}

int NumThreads(int wanted) {
  return wanted > 0 ? wanted : static_cast<int>(std::max(1U, std::thread::hardware_concurrency()));
}

}  // namespace

ExitCode Simulate(const SimulateArguments& arguments,
                  const FlightBagWriter& write_bag,
                  const std::atomic<bool>& stop,
                  Console* console) {
  const Stopwatch stopwatch;
  const Photographer photographer = MakePhotographer(arguments);
  const std::vector<std::size_t> photo_idxs = ChoosePhotos(arguments, photographer.photos());
  OpenSimulatedFolder(arguments.output, photographer.scenario());
  WriteFlightFiles(photographer, photo_idxs, arguments.output);
  const int num_threads = NumThreads(arguments.num_threads);
  const Stopwatch photo_stopwatch;
  PhotoSeries series(photographer, photo_idxs, arguments.output, stop, console);
  const int num_taken = series.Take(num_threads);
  const double photos_s = photo_stopwatch.Seconds();
  if (stop) {
    console->PrintLine("Interrupted; the same command goes on.");
    return kInterrupted;
  }
  WriteTrueSurface(photographer, num_threads, arguments.output);
  if (write_bag && !arguments.no_bag) {
    WriteBag(photographer, photo_idxs, arguments.output, write_bag);
  } else if (!arguments.no_bag) {
    console->PrintLine("No flight.bag: this program was built without ROS.");
  }
  console->PrintLine(arguments.output + ": " + std::to_string(photo_idxs.size()) + " photos, " +
                     std::to_string(num_taken) + " of them taken now in " + Seconds(photos_s) +
                     "; " + Seconds(stopwatch.Seconds()) + " in all");
  return kDone;
}

}  // namespace plumb::tools

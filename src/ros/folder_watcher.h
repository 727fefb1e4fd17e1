// SPDX-FileCopyrightText: 2026 The Plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <chrono>
#include <cstdint>
#include <map>
#include <string>
#include <vector>

namespace plumb::ros_adapter {

struct WatchOptions {
  // A file that cannot be told complete is taken once it was not touched for so long.
  std::chrono::milliseconds untouched_for{5000};

  // Levels of sub-folders that are searched; 0: the folder alone.
  int max_depth = 0;

  // A sub-folder that is not searched, as are hidden ones, links and sessions.
  std::string excluded_folder;
};

// Finds the photos (IsPhotoName) that appear in a folder and its sub-folders, each once it is
// complete: closed by its writer or renamed into place (inotify) and, if a JPEG, with its end
// marker; a file that cannot be told complete (a network folder, a cut JPEG) once it was not
// touched for a while. A photo that is changed later counts as a new one. Not thread-safe.
class FolderWatcher {
 public:
  // The folder may be absent, as a card that is not plugged in: it is watched once it is there.
  // Throws std::runtime_error naming it and the cure if it is no folder or cannot be read.
  FolderWatcher(const std::string& folder, const WatchOptions& options);
  ~FolderWatcher();

  FolderWatcher(const FolderWatcher&) = delete;
  FolderWatcher& operator=(const FolderWatcher&) = delete;

  // Names, with their sub-folders, of the photos complete since the last call, by order of arrival;
  // those found together, as all in the first call, by name. Waits at most `timeout` for one.
  std::vector<std::string> Wait(std::chrono::milliseconds timeout);

  // Makes a photo that was named count as new, if it is found again.
  void Forget(const std::string& name);

  // False while the folder is absent, as when a card was pulled; it is watched once it is there.
  bool is_watching() const { return is_watching_; }

 private:
  using Clock = std::chrono::steady_clock;

  struct Stamp {
    std::uintmax_t size = 0;
    std::int64_t changed_ns = 0;

    bool operator==(const Stamp& other) const {
      return size == other.size && changed_ns == other.changed_ns;
    }
  };

  struct Candidate {
    Stamp stamp;
    Clock::time_point since;  // It has looked like this since.
    bool is_closed = false;   // Its writer has closed it, by inotify.
    bool is_reported = false;
  };

  static Clock::duration Age(const Stamp& stamp);

  void WaitForEvents(std::chrono::milliseconds timeout);
  void Scan();
  bool List(const std::string& prefix, int depth, std::vector<std::string>* names);
  bool IsSearched(const std::string& name) const;
  void Watch(const std::string& prefix);
  void Look(const std::string& name, bool is_closed);
  bool IsComplete(const std::string& name, const Candidate& candidate) const;
  std::vector<std::string> TakeComplete();

  std::string folder_;
  WatchOptions options_;
  int inotify_ = -1;                            // Without one, scanning must do.
  std::map<int, std::string> prefix_of_watch_;  // "DCIM/100MEDIA/" and the like.
  bool is_watching_ = false;
  bool has_scanned_ = false;
  Clock::time_point last_scan_;
  std::map<std::string, Candidate> candidates_;
  std::vector<std::string> arrivals_;  // Names in the order their files were last closed.
};

}  // namespace plumb::ros_adapter

// SPDX-FileCopyrightText: 2026 The Plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "ros/folder_watcher.h"

#include <poll.h>
#include <sys/inotify.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <climits>
#include <filesystem>
#include <fstream>
#include <stdexcept>
#include <system_error>

#include "plumbline/image/photo_name.h"

namespace plumb::ros_adapter {
namespace {

namespace fs = std::filesystem;

// Network and some FAT file systems tell inotify nothing.
constexpr std::chrono::milliseconds kScanEvery{1000};

// How soon a file that is not complete is looked at again.
constexpr std::chrono::milliseconds kRetryEvery{50};

// Cameras may pad a JPEG after its end marker.
constexpr std::streamoff kMaxPadding = 65536;

bool IsHidden(const std::string& name) { return name.empty() || name.front() == '.'; }

enum class End { kMissing, kPadded, kExact, kNotMarked };

// What the end of a file tells. Only a JPEG marks it; within its pixels, the mark cannot occur.
End FindEnd(const std::string& path) {
  std::ifstream file(path, std::ios::binary);
  char start[2] = {};
  if (!file.read(start, 2)) return End::kMissing;
  if (start[0] != '\xFF' || start[1] != '\xD8') return End::kNotMarked;
  file.seekg(0, std::ios::end);
  const std::streamoff size = file.tellg();
  const std::streamoff num = std::min(size, kMaxPadding);
  std::string tail(static_cast<std::size_t>(num), '\0');
  file.seekg(size - num);
  if (!file.read(tail.data(), num)) return End::kMissing;
  const std::size_t mark = tail.rfind("\xFF\xD9");
  if (mark == std::string::npos) return End::kMissing;
  return mark + 2 == tail.size() ? End::kExact : End::kPadded;
}

}  // namespace

FolderWatcher::FolderWatcher(const std::string& folder, const WatchOptions& options)
    : folder_(folder), options_(options) {
  std::error_code error;
  const fs::directory_iterator entries(folder, error);
  is_watching_ = !error;
  if (error == std::errc::not_a_directory) {
    throw std::runtime_error(folder + ": is a file; name the folder the photos lie in");
  }
  if (error && error != std::errc::no_such_file_or_directory) {
    throw std::runtime_error(folder + ": cannot be read: " + error.message() +
                             "; make it readable for the user who starts this");
  }
  inotify_ = inotify_init1(IN_NONBLOCK | IN_CLOEXEC);
  Watch("");
}

FolderWatcher::~FolderWatcher() {
  if (inotify_ >= 0) close(inotify_);
}

// Adding the same folder again changes nothing; another one mounted in its place is new.
void FolderWatcher::Watch(const std::string& prefix) {
  const std::uint32_t events = IN_CLOSE_WRITE | IN_MOVED_TO | IN_CREATE | IN_ONLYDIR;
  const int watch = inotify_add_watch(inotify_, (folder_ + '/' + prefix).c_str(), events);
  if (watch >= 0) prefix_of_watch_[watch] = prefix;
}

std::vector<std::string> FolderWatcher::Wait(std::chrono::milliseconds timeout) {
  const Clock::time_point deadline = Clock::now() + timeout;
  while (true) {
    if (!has_scanned_ || Clock::now() - last_scan_ >= kScanEvery) Scan();
    std::vector<std::string> complete = TakeComplete();
    const Clock::time_point now = Clock::now();
    if (!complete.empty() || now >= deadline) return complete;
    const auto left = std::chrono::ceil<std::chrono::milliseconds>(deadline - now);
    WaitForEvents(std::min(left, arrivals_.empty() ? kScanEvery : kRetryEvery));
  }
}

void FolderWatcher::WaitForEvents(std::chrono::milliseconds timeout) {
  pollfd descriptor{inotify_, POLLIN, 0};
  if (poll(&descriptor, 1, static_cast<int>(timeout.count())) <= 0) return;
  alignas(inotify_event) char buffer[16 * (sizeof(inotify_event) + NAME_MAX + 1)];
  bool must_scan = false;
  for (ssize_t num = 0; (num = read(inotify_, buffer, sizeof buffer)) > 0;) {
    for (ssize_t at = 0; at < num;) {
      const auto* event = reinterpret_cast<const inotify_event*>(buffer + at);
      must_scan |= (event->mask & (IN_Q_OVERFLOW | IN_ISDIR)) != 0;
      const bool is_closed = (event->mask & (IN_CLOSE_WRITE | IN_MOVED_TO)) != 0;
      if (is_closed && event->len > 0) Look(prefix_of_watch_[event->wd] + event->name, true);
      if ((event->mask & IN_IGNORED) != 0) prefix_of_watch_.erase(event->wd);
      at += static_cast<ssize_t>(sizeof(inotify_event) + event->len);
    }
  }
  if (must_scan) Scan();
}

void FolderWatcher::Scan() {
  std::vector<std::string> names;
  is_watching_ = List("", 0, &names);
  std::sort(names.begin(), names.end());
  for (const std::string& name : names) Look(name, /*is_closed=*/false);
  has_scanned_ = true;
  last_scan_ = Clock::now();
}

// The names in the sub-folder `prefix` and below; false if it cannot be read.
bool FolderWatcher::List(const std::string& prefix, int depth, std::vector<std::string>* names) {
  std::error_code error;
  fs::directory_iterator entry(folder_ + '/' + prefix, error);
  if (error) return false;
  Watch(prefix);
  for (; !error && entry != fs::directory_iterator(); entry.increment(error)) {
    std::error_code ignored;  // What cannot be told is looked at as a file.
    const std::string name = prefix + entry->path().filename().string();
    if (entry->symlink_status(ignored).type() != fs::file_type::directory) {
      names->push_back(name);
    } else if (depth < options_.max_depth && IsSearched(name)) {
      List(name + '/', depth + 1, names);
    }
  }
  return true;
}

bool FolderWatcher::IsSearched(const std::string& name) const {
  std::error_code ignored;
  const fs::path path = folder_ + '/' + name;
  return !IsHidden(path.filename().string()) && !fs::exists(path / "session.db", ignored) &&
         !fs::equivalent(path, options_.excluded_folder, ignored);
}

void FolderWatcher::Look(const std::string& name, bool is_closed) {
  struct stat status {};
  if (!IsPhotoName(fs::path(name).filename().string()) ||
      stat((folder_ + '/' + name).c_str(), &status) != 0)
    return;
  if (!S_ISREG(status.st_mode)) return;
  const Stamp stamp{static_cast<std::uintmax_t>(status.st_size),
                    status.st_mtim.tv_sec * 1'000'000'000LL + status.st_mtim.tv_nsec};
  auto [it, is_changed] = candidates_.try_emplace(name);
  Candidate& candidate = it->second;
  is_changed |= !(candidate.stamp == stamp);
  if (is_changed) candidate = {stamp, Clock::now() - Age(stamp), false, false};
  candidate.is_closed |= is_closed;
  if (candidate.is_reported || !(is_changed || is_closed)) return;
  arrivals_.erase(std::remove(arrivals_.begin(), arrivals_.end(), name), arrivals_.end());
  arrivals_.push_back(name);
}

void FolderWatcher::Forget(const std::string& name) {
  candidates_.erase(name);
  arrivals_.erase(std::remove(arrivals_.begin(), arrivals_.end(), name), arrivals_.end());
}

// How long ago a file was changed, by its own stamp.
FolderWatcher::Clock::duration FolderWatcher::Age(const Stamp& stamp) {
  const auto now = std::chrono::system_clock::now().time_since_epoch();
  const auto age = now - std::chrono::nanoseconds(stamp.changed_ns);
  return std::chrono::duration_cast<Clock::duration>(
      std::clamp<std::chrono::nanoseconds>(age, std::chrono::seconds(0), std::chrono::hours(1)));
}

bool FolderWatcher::IsComplete(const std::string& name, const Candidate& candidate) const {
  if (Clock::now() - candidate.since >= options_.untouched_for) return true;
  const End end = FindEnd(folder_ + '/' + name);
  return candidate.is_closed ? end != End::kMissing : end == End::kExact;
}

std::vector<std::string> FolderWatcher::TakeComplete() {
  std::vector<std::string> complete;
  for (const std::string& name : std::vector<std::string>(arrivals_)) {
    Look(name, /*is_closed=*/false);  // It may have grown since.
    Candidate& candidate = candidates_.at(name);
    if (!IsComplete(name, candidate)) continue;
    candidate.is_reported = true;
    complete.push_back(name);
    arrivals_.erase(std::remove(arrivals_.begin(), arrivals_.end(), name), arrivals_.end());
  }
  return complete;
}

}  // namespace plumb::ros_adapter

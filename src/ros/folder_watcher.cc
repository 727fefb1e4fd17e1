// SPDX-FileCopyrightText: 2026 The Plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "ros/folder_watcher.h"

#include <poll.h>
#include <sys/inotify.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <climits>
#include <cstring>
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

FolderWatcher::FolderWatcher(const std::string& folder, std::chrono::milliseconds untouched_for)
    : folder_(folder), untouched_for_(untouched_for) {
  inotify_ = inotify_init1(IN_NONBLOCK | IN_CLOEXEC);
  if (inotify_ >= 0 && AddWatch()) return;
  const std::string cause = std::strerror(errno);
  if (inotify_ >= 0) close(inotify_);
  throw std::runtime_error("cannot watch the folder " + folder + ": " + cause);
}

FolderWatcher::~FolderWatcher() { close(inotify_); }

// Adding the same folder again changes nothing; another one mounted in its place is new.
bool FolderWatcher::AddWatch() {
  const std::uint32_t events = IN_CLOSE_WRITE | IN_MOVED_TO | IN_ONLYDIR;
  is_watching_ = inotify_add_watch(inotify_, folder_.c_str(), events) >= 0;
  return is_watching_;
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
  for (ssize_t num = 0; (num = read(inotify_, buffer, sizeof buffer)) > 0;) {
    for (ssize_t at = 0; at < num;) {
      const auto* event = reinterpret_cast<const inotify_event*>(buffer + at);
      if (event->len > 0) Look(event->name, /*is_closed=*/true);
      if ((event->mask & IN_Q_OVERFLOW) != 0) Scan();
      at += static_cast<ssize_t>(sizeof(inotify_event) + event->len);
    }
  }
}

void FolderWatcher::Scan() {
  AddWatch();
  std::error_code error;
  std::vector<std::string> names;
  for (const fs::directory_entry& entry : fs::directory_iterator(folder_, error)) {
    names.push_back(entry.path().filename().string());
  }
  std::sort(names.begin(), names.end());
  for (const std::string& name : names) Look(name, /*is_closed=*/false);
  has_scanned_ = true;
  last_scan_ = Clock::now();
}

void FolderWatcher::Look(const std::string& name, bool is_closed) {
  struct stat status {};
  if (!IsPhotoName(name) || stat((folder_ + '/' + name).c_str(), &status) != 0) return;
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

// How long ago a file was changed, by its own stamp.
FolderWatcher::Clock::duration FolderWatcher::Age(const Stamp& stamp) {
  const auto now = std::chrono::system_clock::now().time_since_epoch();
  const auto age = now - std::chrono::nanoseconds(stamp.changed_ns);
  return std::chrono::duration_cast<Clock::duration>(
      std::clamp<std::chrono::nanoseconds>(age, std::chrono::seconds(0), std::chrono::hours(1)));
}

bool FolderWatcher::IsComplete(const std::string& name, const Candidate& candidate) const {
  if (Clock::now() - candidate.since >= untouched_for_) return true;
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

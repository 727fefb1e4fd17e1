// SPDX-FileCopyrightText: 2026 The Plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "map/session_lock.h"

#include <fcntl.h>
#include <sys/file.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <filesystem>
#include <stdexcept>
#include <system_error>

namespace plumb {

SessionLock::SessionLock(const std::string& folder) {
  std::error_code error;
  if (std::filesystem::is_regular_file(folder, error)) {
    throw std::runtime_error(folder +
                             ": is a file; a session is a folder: name a new one, or one to go on "
                             "with");
  }
  std::filesystem::create_directories(folder, error);
  if (error) {
    throw std::runtime_error(folder + ": cannot make this folder: " + error.message() +
                             "; make its parent writable or choose another session folder");
  }
  const std::string path = folder + "/session.lock";
  descriptor_ = ::open(path.c_str(), O_RDWR | O_CREAT | O_CLOEXEC, 0666);
  if (descriptor_ < 0) {
    throw std::runtime_error(path + ": cannot create: " + std::strerror(errno) +
                             "; make the folder writable or choose another session folder");
  }
  if (::flock(descriptor_, LOCK_EX | LOCK_NB) == 0) return;
  const int cause = errno;
  ::close(descriptor_);
  if (cause == EWOULDBLOCK) {
    throw std::runtime_error(folder +
                             ": another program writes this session; wait for it, end it, or "
                             "choose another session folder");
  }
  throw std::runtime_error(path + ": cannot lock: " + std::strerror(cause) +
                           "; choose a session folder on a local disk");
}

SessionLock::~SessionLock() { ::close(descriptor_); }

}  // namespace plumb

// SPDX-FileCopyrightText: 2026 The Plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>

namespace plumb {

// Holds DIR/session.lock, so that one program at a time writes a session. The system frees it when
// the program ends, however it ends.
class SessionLock {
 public:
  // Makes the folder if need be. Throws std::runtime_error naming it if another program
  // holds the lock or it cannot be made.
  explicit SessionLock(const std::string& folder);
  ~SessionLock();
  SessionLock(const SessionLock&) = delete;
  SessionLock& operator=(const SessionLock&) = delete;

 private:
  int descriptor_;
};

}  // namespace plumb

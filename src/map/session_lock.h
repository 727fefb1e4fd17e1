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

// Keeps writers out of a session while it lives, unless one is at work.
class SessionReadLock {
 public:
  explicit SessionReadLock(const std::string& folder);
  ~SessionReadLock();
  SessionReadLock(const SessionReadLock&) = delete;
  SessionReadLock& operator=(const SessionReadLock&) = delete;

  // Also if there is no lock file, as in a copied session: nobody has ever written there.
  bool is_held() const { return is_held_; }

 private:
  int descriptor_;
  bool is_held_;
};

}  // namespace plumb

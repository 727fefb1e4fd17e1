// SPDX-FileCopyrightText: 2026 The Plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <functional>

#include "plumbline/common/stage.h"
#include "plumbline/map/session_store.h"
#include "plumbline/sfm/mapper.h"
#include "tools/photo_reader.h"

namespace plumb::tools {

// Writes what the mapper says to the session in a thread of its own, so that no verdict waits
// for the disk, in the order it was said. When the session refuses (a full disk), the next
// call throws its std::runtime_error.
class SessionRecorder : public MapperListener {
 public:
  using VerdictCallback = std::function<void(const PhotoVerdict&)>;

  // `store` must outlive this and is the recorder's until Close. `on_verdict` is called in
  // the mapper's thread.
  SessionRecorder(SessionStore* store, VerdictCallback on_verdict);

  // The bytes, unless the session holds them, and the analysis.
  void SavePhoto(PhotoId id, const ReadPhoto& photo, Timestamp exposure_time);

  void OnVerdict(const PhotoVerdict& verdict) override;
  void OnMapDelta(const MapDelta& delta) override;
  void OnSeconds(PhotoId photo, const StageSeconds& seconds) override;

  // Waits until all is written.
  void Close() { stage_.Close(); }

 private:
  using Write = std::function<void(SessionStore&)>;

  void Push(Write write);

  VerdictCallback on_verdict_;
  Stage<Write> stage_;
};

}  // namespace plumb::tools

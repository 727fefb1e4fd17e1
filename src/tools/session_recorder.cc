// SPDX-FileCopyrightText: 2026 The Plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "tools/session_recorder.h"

#include <utility>

namespace plumb::tools {
namespace {

// Four writes a photo: some twenty photos may be ahead of a slow disk before mapping waits
// for it, which bounds the memory of their bytes.
constexpr std::size_t kMaxQueuedWrites = 80;

}  // namespace

SessionRecorder::SessionRecorder(SessionStore* store, VerdictCallback on_verdict)
    : on_verdict_(std::move(on_verdict)),
      stage_(kMaxQueuedWrites, [store](const Write& write) { write(*store); }) {}

void SessionRecorder::SavePhoto(PhotoId id, const ReadPhoto& photo, Timestamp exposure_time) {
  Push([id, photo, exposure_time](SessionStore& store) {
    if (!photo.task.stored_id) store.SavePhoto(id, photo.task.source_name, *photo.bytes);
    store.SaveAnalysis(id, exposure_time, photo.analysis);
  });
}

void SessionRecorder::OnVerdict(const PhotoVerdict& verdict) {
  on_verdict_(verdict);
  Push([verdict](SessionStore& store) { store.SaveVerdict(verdict); });
}

void SessionRecorder::OnMapDelta(const MapDelta& delta) {
  Push([delta](SessionStore& store) { store.Apply(delta); });
}

void SessionRecorder::OnSeconds(PhotoId photo, const StageSeconds& seconds) {
  Push([photo, seconds](SessionStore& store) { store.SaveSeconds(photo, seconds); });
}

void SessionRecorder::Push(Write write) {
  if (!stage_.Push(std::move(write))) stage_.Close();  // Throws what made it stop.
}

}  // namespace plumb::tools

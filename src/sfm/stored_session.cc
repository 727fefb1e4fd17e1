// SPDX-FileCopyrightText: 2026 The Plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "plumbline/sfm/stored_session.h"

#include <map>
#include <memory>
#include <set>
#include <utility>

#include "sfm/photo_record.h"

namespace plumb {
namespace {

MapperPhoto LoadPhoto(const SessionStore& store, const StoredPhoto& stored) {
  MapperPhoto photo;
  photo.id = stored.id;
  photo.name = stored.name;
  photo.exposure_time = stored.exposure_time.value_or(Timestamp{});
  photo.analysis = *stored.analysis;
  photo.analysis.features = store.LoadFeatures(stored.id);
  return photo;
}

}  // namespace

StoredSession ReadStoredSession(const SessionStore& store) {
  StoredSession session;
  session.snapshot = store.Snapshot();
  std::set<PhotoId> views;
  for (const ViewState& view : session.snapshot.views_set) views.insert(view.photo);
  std::map<PhotoId, PhotoVerdict> verdicts;
  for (PhotoVerdict& verdict : store.LatestVerdicts()) {
    verdicts[verdict.photo] = std::move(verdict);
  }
  for (StoredPhoto& stored : store.Photos()) {
    const auto verdict = verdicts.find(stored.id);
    const bool is_answered = stored.analysis && verdict != verdicts.end();
    const bool is_lost = is_answered && verdict->second.status == VerdictStatus::kAccepted &&
                         views.count(stored.id) == 0;
    if (is_answered && !is_lost) {
      session.photos.push_back(LoadPhoto(store, stored));
      session.verdicts.push_back(std::move(verdict->second));
    } else {
      session.unfinished.push_back(std::move(stored));
    }
  }
  return session;
}

Map ReadStoredMap(const SessionStore& store) {
  const MapDelta snapshot = store.Snapshot();
  Camera camera = store.camera();
  if (snapshot.lens) {
    camera = Camera(
        camera.name(), camera.width_px(), camera.height_px(), camera.model(), *snapshot.lens);
  }
  std::map<PhotoId, std::shared_ptr<const FeatureSet>> features;
  for (const ViewState& view : snapshot.views_set) {
    // As the mapper numbers them.
    features[view.photo] =
        MakePhotoRecord(
            camera, view.photo, view.name, view.exposure_time, store.LoadFeatures(view.photo))
            .features;
  }
  return Map::FromSnapshot(snapshot, features);
}

}  // namespace plumb

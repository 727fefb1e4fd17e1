// SPDX-FileCopyrightText: 2026 The Plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "plumbline/camera/camera.h"
#include "plumbline/common/ids.h"
#include "plumbline/common/timestamp.h"
#include "plumbline/image/photo_analysis.h"
#include "plumbline/map/map.h"
#include "plumbline/map/map_delta.h"
#include "plumbline/map/photo_verdict.h"
#include "plumbline/sfm/bundle_constraints.h"
#include "plumbline/sfm/mapper_options.h"

namespace plumb {

// A photo as it comes to the mapper. Ids grow by arrival; they need not be consecutive.
struct MapperPhoto {
  PhotoId id;
  std::string name;
  Timestamp exposure_time;
  PhotoAnalysis analysis;
  double seconds_since_arrival = 0.0;  // From the first byte to the call of Mapper::Add.
};

// Hears what the mapper found, in the thread that called it.
class MapperListener {
 public:
  virtual ~MapperListener() = default;

  // As soon as it is known, before the map is extended.
  virtual void OnVerdict(const PhotoVerdict& verdict) = 0;
  // After the map has changed; numbered without gaps.
  virtual void OnMapDelta(const MapDelta& delta) = 0;
  // Once a photo's stages after the verdict are timed (expand_s and bundle_s are set).
  virtual void OnSeconds(PhotoId photo, const StageSeconds& seconds) = 0;
};

// Puts the steps in order: retrieve, match, localise, verdict, expand, local
// bundle, global bundle in the background, and the refused photos again. One caller at a time;
// `listener` must outlive the mapper. With options.deterministic the same photos in the same order
// give the same map; otherwise a finished background bundle is taken in as soon as it is there.
class Mapper {
 public:
  // Throws std::invalid_argument if options.Problems() is not empty.
  Mapper(const MapperOptions& options, const Camera& camera, MapperListener* listener);
  ~Mapper();

  // Takes one photo all the way. The listener gets its verdict, new verdicts of
  // earlier photos, and the deltas. Never throws for what the photo holds.
  void Add(MapperPhoto photo);

  // Takes in a finished background bundle, if any, and tries waiting photos; call it when idle.
  void Poll();

  // No more photos for now: waits for the background, tries refused photos until no
  // more fit, bundles everything. Photos may be added afterwards.
  void Finish();

  // Markers and measured positions for the global bundles from now on, in place of those given
  // before. When the map moves they go along (MovedWithMap). Nothing waits for them.
  void SetConstraints(BundleConstraints constraints);

  // Goes on from a stored session: its photos, the latest verdicts and the map.
  void Restore(std::vector<MapperPhoto> photos,
               const std::vector<PhotoVerdict>& verdicts,
               const MapDelta& snapshot);

  const Map& map() const;
  const Camera& camera() const;  // With the refined lens, if it is refined.

 private:
  class Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace plumb

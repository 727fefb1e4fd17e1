// SPDX-FileCopyrightText: 2026 The Plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <atomic>
#include <cstdint>
#include <functional>
#include <memory>
#include <mutex>
#include <string>
#include <vector>

#include "plumbline/camera/camera.h"
#include "plumbline/common/stage.h"
#include "plumbline/image/gray_photo.h"
#include "ros/calibrator_ros_options.h"
#include "ros/calibrator_state.h"
#include "ros/view_choice.h"

namespace plumb::ros_adapter {

// Runs a calibration: one thread finds the markers of photos and of a video's images, picks the
// latter, and hands what counts to a CalibrationCollector. Thread-safe; state() never waits for
// work that is being done.
class LiveCalibrator {
 public:
  // Called for each image that was taken or could not be, from the thread that looked at it.
  using OnView = std::function<void(const CalibratorView&)>;

  // Throws std::invalid_argument naming what is wrong with the options.
  explicit LiveCalibrator(const CalibratorRosOptions& options, OnView on_view = {});

  // What still waits is not looked at.
  ~LiveCalibrator();

  // Takes a photo file; waits while the queue is full.
  void TakePhoto(const std::string& name, std::vector<std::uint8_t> bytes);

  // Takes an image of a video, to be decoded by the thread that looks at it. Never waits; false if
  // the queue is full.
  bool OfferImage(double stamp_s, std::function<GrayPhoto()> decode);

  // The whole calibration of what was taken, which becomes the result. This and what follows wait
  // for one another, and answer in a sentence; none throws for what the disk or the data hold.
  Outcome Calibrate();

  // Writes the result: camera.yaml and the report, into options.output_folder.
  Outcome Save();

  // Hands the result's camera to `send`, which says what became of it.
  Outcome Commit(const std::function<Outcome(const Camera&)>& send);

  // How the sources go, and whether there is a driver to commit to; in the place of what was noted
  // before.
  void NoteSources(std::vector<SourceNote> sources, bool has_driver);

  CalibratorState state() const;

 private:
  struct Arrived {
    std::string name;  // Empty: of a video.
    double stamp_s = 0.0;
    std::function<GrayPhoto()> decode;
  };

  // Of the looking thread.
  void Look(const Arrived& arrived);
  void LookAt(const cv::Mat& gray, const Arrived& arrived, CalibratorView* view);
  void Collect(const cv::Mat& gray, std::vector<MarkerDetection> markers, CalibratorView* view);
  bool IsCounted(int id) const;
  void Show(const CalibratorView& view);

  Outcome Do(const std::string& busy, const std::function<Outcome()>& action);
  Outcome CalibrateNow();
  Outcome SaveNow();
  void KeepEarlierOutput() const;

  template <typename Change>
  void Update(const Change& change);

  const CalibratorRosOptions options_;
  const OnView on_view_;
  CalibrationCollector collector_;
  std::atomic<bool> is_stopping_{false};

  // Of the looking thread.
  ViewChoice choice_;
  int num_views_ = 0;

  std::mutex action_mutex_;
  bool has_saved_ = false;  // What lies in the output folder is ours.

  mutable std::mutex mutex_;  // Of what follows.
  CalibratorState state_;
  std::uint64_t num_collected_ = 0;  // Grows with every photo taken.

  std::unique_ptr<Stage<Arrived>> looking_;  // Last: it uses all of the above until its end.
};

}  // namespace plumb::ros_adapter

// SPDX-FileCopyrightText: 2026 The Plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "marker/outlines.h"

#include <array>
#include <opencv2/core.hpp>

#include "plumbline/common/check.h"

namespace plumb {
namespace {

// What a pixel of the mask says. kClosed ones lie on an outline that has been visited and whose
// outside is to their right, so that no hole begins there again.
enum Mark : std::uint8_t { kOutside = 0, kInside = 1, kVisited = 2, kClosed = 3 };

// Directions, from the right (0) by 45 degrees towards the image's top.
constexpr int kNumDirections = 8;
constexpr int kRight = 0;
constexpr int kLeft = 4;
constexpr std::array<int, kNumDirections> kStepX = {1, 1, 0, -1, -1, -1, 0, 1};
constexpr std::array<int, kNumDirections> kStepY = {0, -1, -1, -1, 0, 1, 1, 1};

constexpr int Wrapped(int direction) { return direction & (kNumDirections - 1); }

// Border following: Suzuki and Abe, Topological Structural Analysis of Digitized Binary Images by
// Border Following, CVGIP 30(1), 1985, Algorithm 1 without the borders' hierarchy.
class Tracer {
 public:
  explicit Tracer(cv::Mat& mask) : mask_(mask) {
    for (int i = 0; i < kNumDirections; ++i) {
      offsets_[i] = kStepY[i] * static_cast<std::ptrdiff_t>(mask.step) + kStepX[i];
    }
  }

  // The outline that passes through a pixel whose neighbour in the direction `outside` is outside.
  const std::vector<cv::Point>& Trace(cv::Point start, int outside) {
    points_.clear();
    std::uint8_t* const first = mask_.ptr(start.y) + start.x;
    int direction = outside;
    do {
      direction = Wrapped(direction - 1);
    } while (direction != outside && first[offsets_[direction]] == kOutside);
    points_.push_back(start);
    if (direction == outside) {
      *first = kClosed;
      return points_;
    }
    Follow(first, first + offsets_[direction], direction);
    return points_;
  }

 private:
  // Goes around from `first`, until it comes there again from `last`, which lies in `direction`.
  void Follow(std::uint8_t* const first, const std::uint8_t* const last, int direction) {
    std::uint8_t* pixel = first;
    cv::Point point = points_.front();
    while (true) {
      const int from = direction;
      do {
        direction = Wrapped(direction + 1);
      } while (pixel[offsets_[direction]] == kOutside);
      if (IsRightSeen(from, direction)) {
        *pixel = kClosed;
      } else if (*pixel == kInside) {
        *pixel = kVisited;
      }
      std::uint8_t* const next = pixel + offsets_[direction];
      if (next == first && pixel == last) return;
      point += cv::Point(kStepX[direction], kStepY[direction]);
      points_.push_back(point);
      pixel = next;
      direction = Wrapped(direction + kLeft);
    }
  }

  // Whether turning from one direction to the other passed the pixel to the right and found it
  // outside.
  static bool IsRightSeen(int from, int to) { return to != kRight && to <= from; }

  cv::Mat& mask_;
  std::array<std::ptrdiff_t, kNumDirections> offsets_{};
  std::vector<cv::Point> points_;
};

void ClearRim(cv::Mat& mask) {
  mask.row(0).setTo(kOutside);
  mask.row(mask.rows - 1).setTo(kOutside);
  mask.col(0).setTo(kOutside);
  mask.col(mask.cols - 1).setTo(kOutside);
}

}  // namespace

void VisitOutlines(cv::Mat& mask, const std::function<void(const std::vector<cv::Point>&)>& visit) {
  PLUMB_CHECK(mask.type() == CV_8UC1);
  if (mask.empty()) return;
  cv::min(mask, static_cast<double>(kInside), mask);
  ClearRim(mask);
  Tracer tracer(mask);
  for (int y = 1; y < mask.rows - 1; ++y) {
    const std::uint8_t* const row = mask.ptr(y);
    for (int x = 1; x < mask.cols; ++x) {
      if (row[x - 1] == kOutside) {
        if (row[x] == kInside) visit(tracer.Trace({x, y}, kLeft));
      } else if (row[x] == kOutside && row[x - 1] != kClosed) {
        visit(tracer.Trace({x - 1, y}, kRight));
      }
    }
  }
}

}  // namespace plumb

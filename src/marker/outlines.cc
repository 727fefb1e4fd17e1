// SPDX-FileCopyrightText: 2026 The Plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "marker/outlines.h"

#include <array>
#include <cstdint>
#include <cstring>
#include <opencv2/core.hpp>

#include "plumbline/common/check.h"

namespace plumb {
namespace {

// Directions, from the right (0) by 45 degrees towards the image's top.
constexpr int kNumDirections = 8;
constexpr int kRight = 0;
constexpr int kLeft = 4;
constexpr std::array<int, kNumDirections> kStepX = {1, 1, 0, -1, -1, -1, 0, 1};
constexpr std::array<int, kNumDirections> kStepY = {0, -1, -1, -1, 0, 1, 1, 1};

constexpr int Wrapped(int direction) { return direction & (kNumDirections - 1); }

// A set of directions, a bit each: of a pixel's neighbours those inside, or its starts: those
// outside where an outline begins that has not been visited. To the left begins a set's own, to the
// right a hole's.
using Directions = std::uint8_t;
constexpr int kNumSets = 256;

constexpr Directions Only(int direction) { return static_cast<Directions>(1 << direction); }

// How an outline goes on from a pixel, and what starts remain there.
struct Turn {
  std::uint8_t direction = 0;
  Directions starts = Only(kRight);
};

// Of a pixel that was come to in the direction `heading`: to the first neighbour inside,
// anticlockwise after where it was come from. If this passes the one to the right, which then is
// outside, no hole's outline begins here any more.
constexpr Turn MakeTurn(int heading, int neighbors) {
  Turn turn;
  for (int i = 1; i <= kNumDirections; ++i) {
    const int direction = Wrapped(heading + kLeft + i);
    if ((neighbors & Only(direction)) != 0) {
      turn.direction = static_cast<std::uint8_t>(direction);
      break;
    }
    if (direction == kRight) turn.starts = 0;
  }
  return turn;
}

// Looked up instead of searched: in texture no processor foresees where a search ends.
constexpr auto MakeTurns() {
  std::array<std::array<Turn, kNumSets>, kNumDirections> turns{};
  for (int heading = 0; heading < kNumDirections; ++heading) {
    for (int neighbors = 0; neighbors < kNumSets; ++neighbors) {
      turns[heading][neighbors] = MakeTurn(heading, neighbors);
    }
  }
  return turns;
}
constexpr auto kTurns = MakeTurns();

// Border following: Suzuki and Abe, Topological Structural Analysis of Digitized Binary Images by
// Border Following, CVGIP 30(1), 1985, Algorithm 1 without the borders' hierarchy. Instead of the
// borders' numbers, the pixels keep their starts.
class Tracer {
 public:
  // Both images have the same size and step.
  Tracer(cv::Mat& starts, const cv::Mat& neighbors)
      : starts_(starts.data),
        neighbors_(neighbors.data),
        step_(static_cast<std::ptrdiff_t>(starts.step)) {}

  // The outline that begins at a pixel whose neighbour in the direction `outside` is outside.
  const std::vector<cv::Point>& Trace(cv::Point start, int outside) {
    points_.clear();
    points_.push_back(start);
    const std::ptrdiff_t first = start.y * step_ + start.x;
    if (neighbors_[first] == 0) {
      starts_[first] = 0;
      return points_;
    }
    int direction = outside;
    do {
      direction = Wrapped(direction - 1);
    } while ((neighbors_[first] & Only(direction)) == 0);
    Follow(first, direction);
    return points_;
  }

 private:
  // Goes around from the first point, until it comes there again from the one in `direction`.
  void Follow(std::ptrdiff_t first, int direction) {
    std::array<std::ptrdiff_t, kNumDirections> offsets{};
    for (int i = 0; i < kNumDirections; ++i) offsets[i] = kStepY[i] * step_ + kStepX[i];
    const std::ptrdiff_t last = first + offsets[direction];
    std::ptrdiff_t at = first;
    cv::Point point = points_.front();
    for (int heading = Wrapped(direction + kLeft);;) {
      const Turn turn = kTurns[heading][neighbors_[at]];
      starts_[at] &= turn.starts;
      heading = turn.direction;
      const std::ptrdiff_t next = at + offsets[heading];
      if (next == first && at == last) return;
      point.x += kStepX[heading];
      point.y += kStepY[heading];
      points_.push_back(point);
      at = next;
    }
  }

  Directions* starts_;
  const Directions* neighbors_;
  std::ptrdiff_t step_;
  std::vector<cv::Point> points_;
};

// The mask's pixels become 0 on its rim and elsewhere 0 or all directions.
void Binarize(cv::Mat& mask) {
  cv::compare(mask, 0.0, mask, cv::CMP_NE);
  mask.row(0).setTo(0);
  mask.row(mask.rows - 1).setTo(0);
  mask.col(0).setTo(0);
  mask.col(mask.cols - 1).setTo(0);
}

// Of a binarized mask, in its step.
cv::Mat NeighborsOf(const cv::Mat& mask) {
  cv::Mat neighbors(mask.rows, static_cast<int>(mask.step), CV_8UC1);
  const int end = mask.cols - 1;  // The compiler cannot know that writing bytes leaves it as it is.
  for (int y = 1; y < mask.rows - 1; ++y) {
    const std::uint8_t* const above = mask.ptr(y - 1);
    const std::uint8_t* const row = mask.ptr(y);
    const std::uint8_t* const below = mask.ptr(y + 1);
    Directions* const result = neighbors.ptr(y);
    for (int x = 1; x < end; ++x) {
      result[x] = static_cast<Directions>((row[x + 1] & Only(0)) | (above[x + 1] & Only(1)) |
                                          (above[x] & Only(2)) | (above[x - 1] & Only(3)) |
                                          (row[x - 1] & Only(4)) | (below[x - 1] & Only(5)) |
                                          (below[x] & Only(6)) | (below[x + 1] & Only(7)));
    }
  }
  return neighbors;
}

// Makes a binarized mask its own starts.
void MarkStarts(const cv::Mat& neighbors, cv::Mat& mask) {
  const int end = mask.cols - 1;
  for (int y = 1; y < mask.rows - 1; ++y) {
    std::uint8_t* const row = mask.ptr(y);
    const Directions* const inside = neighbors.ptr(y);
    for (int x = 1; x < end; ++x) {
      row[x] = static_cast<Directions>(row[x] & ~inside[x] & (Only(kLeft) | Only(kRight)));
    }
  }
}

// The first column from x on with a start; `cols` if there is none.
int NextStart(const Directions* row, int x, int cols) {
  constexpr int kStride = sizeof(std::uint64_t);  // Most pixels have none.
  for (std::uint64_t several = 0; x + kStride <= cols; x += kStride) {
    std::memcpy(&several, row + x, kStride);
    if (several != 0) break;
  }
  while (x < cols && row[x] == 0) ++x;
  return x;
}

}  // namespace

void VisitOutlines(cv::Mat& mask, const std::function<void(const std::vector<cv::Point>&)>& visit) {
  PLUMB_CHECK(mask.type() == CV_8UC1);
  if (mask.empty()) return;
  Binarize(mask);
  const cv::Mat neighbors = NeighborsOf(mask);
  MarkStarts(neighbors, mask);
  Tracer tracer(mask, neighbors);
  for (int y = 1; y < mask.rows - 1; ++y) {
    const Directions* const row = mask.ptr(y);
    for (int x = 0; (x = NextStart(row, x, mask.cols)) < mask.cols; ++x) {
      if ((row[x] & Only(kLeft)) != 0) visit(tracer.Trace({x, y}, kLeft));
      if ((row[x] & Only(kRight)) != 0) visit(tracer.Trace({x, y}, kRight));
    }
  }
}

}  // namespace plumb

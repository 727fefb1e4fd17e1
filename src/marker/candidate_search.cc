// SPDX-FileCopyrightText: 2026 The Plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "marker/candidate_search.h"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <opencv2/core.hpp>
#include <opencv2/imgproc.hpp>

#include "image/parallel_for.h"
#include "marker/outline_moments.h"
#include "marker/outlines.h"

namespace plumb {
namespace {

// A level of the pyramid shows diameters of kMinDiameter to kMaxDiameter of its own pixels; the
// next level, of half its size, takes over well before.
constexpr double kMinDiameter = 6.0;
constexpr double kMaxDiameter = 48.0;

// Sides of the local mean's square. The wide one holds a tilted marker of any size; the narrow one,
// for the smallest, keeps a marker apart from what lies beyond its quiet zone.
constexpr int kWideWindow = 31;
constexpr int kNarrowWindow = 13;

// Below this many pixels the code's cells are neither told apart nor blurred into one blob, and
// notch the outline: the finest level on which the smallest marker has fewer is smoothed once more.
constexpr double kMaxBlobDiameter = 9.0;

// High, for each band costs its margin once more; enough of them for all cores.
constexpr int kBandHeight = 512;
constexpr int kBandMargin = static_cast<int>(kMaxDiameter) / 2 + kWideWindow / 2 + 2;

// An outline's area over that of the ellipse of its second moments. 1 for ellipses, 0.955 for
// a rectangle; digital discs of 6 pixels stay above 0.96, but specks on their rim cost some more.
constexpr double kMinEllipticity = 0.90;

// The box that holds a candidate is at least so many pixels long and wide.
constexpr int kMinBoxLength = static_cast<int>(kMinDiameter) - 2;
constexpr int kMinBoxWidth = 3;

// There and back again. Most outlines in texture are shorter.
constexpr std::size_t kMinOutlineSize = 2 * (kMinBoxLength - 1);

// For outlines of a few pixels cv::boundingRect mostly unwraps its argument.
cv::Rect BoxOf(const std::vector<cv::Point>& outline) {
  cv::Point least = outline.front();
  cv::Point greatest = outline.front();
  for (const cv::Point& point : outline) {
    least = {std::min(least.x, point.x), std::min(least.y, point.y)};
    greatest = {std::max(greatest.x, point.x), std::max(greatest.y, point.y)};
  }
  return {least, greatest + cv::Point(1, 1)};
}

bool HasPossibleSize(const cv::Rect& box, const MarkerDetectorOptions& options) {
  const int longer = std::max(box.width, box.height);
  const int shorter = std::min(box.width, box.height);
  return longer <= kMaxDiameter && longer >= kMinBoxLength && shorter >= kMinBoxWidth &&
         shorter >= 0.8 * options.min_axis_ratio * longer;
}

// The ellipse of an outline's second moments; nothing if the outline is no ellipse.
std::optional<Ellipse> EllipseOfOutline(const std::vector<cv::Point>& outline) {
  const OutlineMoments moments = MomentsOf(outline);
  if (moments.area_px2 < 4.0) return std::nullopt;
  const double determinant = moments.spread_px2.determinant();
  if (determinant <= 0.0) return std::nullopt;
  if (moments.area_px2 < kMinEllipticity * 4.0 * M_PI * std::sqrt(determinant)) return std::nullopt;
  Ellipse ellipse = EllipseOfSquare(moments.centroid_px, 4.0 * moments.spread_px2);
  ellipse.semi_major_px += 0.5;  // The outline runs through the centres of the outermost pixels.
  ellipse.semi_minor_px += 0.5;
  return ellipse;
}

// How dark pixels are told.
struct Search {
  int window = kWideWindow;
  bool is_smoothed = false;
};

// One search on one level of the pyramid.
class Level {
 public:
  Level(const MarkerDetectorOptions& options, cv::Mat gray, double reduction, const Search& search)
      : options_(options), gray_(std::move(gray)), reduction_(reduction), search_(search) {}

  int num_bands() const { return (gray_.rows + kBandHeight - 1) / kBandHeight; }

  // Blobs whose box is centred in a band.
  std::vector<MarkerCandidate> SearchBand(int band) const {
    const int first = band * kBandHeight;
    const int last = std::min(gray_.rows, first + kBandHeight);
    const cv::Range rows(std::max(0, first - kBandMargin),
                         std::min(gray_.rows, last + kBandMargin));
    cv::Mat dark = DarkPixels(rows);
    std::vector<MarkerCandidate> candidates;
    VisitOutlines(dark, [&](const std::vector<cv::Point>& outline) {
      if (outline.size() < kMinOutlineSize) return;
      const cv::Rect box = BoxOf(outline);
      const int middle = rows.start + box.y + box.height / 2;
      if (middle < first || middle >= last || !HasPossibleSize(box, options_)) return;
      if (const std::optional<MarkerCandidate> candidate = Candidate(outline, rows.start)) {
        candidates.push_back(*candidate);
      }
    });
    return candidates;
  }

 private:
  cv::Mat DarkPixels(const cv::Range& rows) const {
    cv::Mat part = gray_.rowRange(rows);
    cv::Mat mean;
    cv::blur(part, mean, {search_.window, search_.window}, {-1, -1}, cv::BORDER_REPLICATE);
    if (search_.is_smoothed) {
      cv::Mat smooth;
      cv::blur(part, smooth, {3, 3}, {-1, -1}, cv::BORDER_REPLICATE);
      part = smooth;
    }
    cv::subtract(mean, part, mean);  // Saturates at 0.
    cv::threshold(mean, mean, options_.min_darkness, 255.0, cv::THRESH_BINARY);
    return mean;
  }

  // The outline is given in the rows from first_row on.
  std::optional<MarkerCandidate> Candidate(const std::vector<cv::Point>& outline,
                                           int first_row) const {
    std::optional<Ellipse> ellipse = EllipseOfOutline(outline);
    if (!ellipse) return std::nullopt;
    ellipse->center_px.y() += first_row;
    if (ellipse->semi_minor_px < options_.min_axis_ratio * ellipse->semi_major_px) {
      return std::nullopt;
    }
    // Pixel (0, 0) of a level is centred amid reduction x reduction pixels of the photo.
    ellipse->center_px = (ellipse->center_px.array() + 0.5) * reduction_ - 0.5;
    ellipse->semi_major_px *= reduction_;
    ellipse->semi_minor_px *= reduction_;
    return MarkerCandidate{*ellipse, reduction_};
  }

  const MarkerDetectorOptions& options_;
  cv::Mat gray_;
  double reduction_;
  Search search_;
};

// Cut to whole pixels of the next level.
cv::Mat Reduced(const cv::Mat& gray, int factor) {
  const cv::Size size(gray.cols / factor, gray.rows / factor);
  if (factor == 1 || size.empty()) return gray;
  cv::Mat reduced;
  cv::resize(gray(cv::Rect(0, 0, size.width * factor, size.height * factor)),
             reduced,
             size,
             0,
             0,
             cv::INTER_AREA);
  return reduced;
}

std::vector<Level> BuildPyramid(const MarkerDetectorOptions& options, const cv::Mat& gray) {
  std::vector<Level> levels;
  int reduction = std::max(1, static_cast<int>(options.min_diameter_px / kMinDiameter));
  cv::Mat level = Reduced(gray, reduction);
  levels.emplace_back(options, level, reduction, Search{kNarrowWindow, false});
  bool has_smoothed = false;
  while (true) {
    if (!has_smoothed && options.min_diameter_px < kMaxBlobDiameter * reduction) {
      levels.emplace_back(options, level, reduction, Search{kNarrowWindow, true});
      has_smoothed = true;
    }
    if (std::min(level.cols, level.rows) < kMaxDiameter) return levels;
    level = Reduced(level, 2);
    reduction *= 2;
    levels.emplace_back(options, level, reduction, Search{kWideWindow, false});
  }
}

}  // namespace

std::vector<MarkerCandidate> FindCandidates(const MarkerDetectorOptions& options,
                                            const cv::Mat& gray) {
  const std::vector<Level> levels = BuildPyramid(options, gray);
  std::vector<std::pair<const Level*, int>> bands;
  for (const Level& level : levels) {
    for (int band = 0; band < level.num_bands(); ++band) bands.emplace_back(&level, band);
  }
  std::vector<std::vector<MarkerCandidate>> found(bands.size());
  ParallelFor(options.num_threads, static_cast<int>(bands.size()), 1, [&](int begin, int end) {
    for (int i = begin; i < end; ++i) {
      const auto& [level, band] = bands[static_cast<std::size_t>(i)];
      found[static_cast<std::size_t>(i)] = level->SearchBand(band);
    }
  });
  std::vector<MarkerCandidate> candidates;
  for (const std::vector<MarkerCandidate>& of_band : found) {
    candidates.insert(candidates.end(), of_band.begin(), of_band.end());
  }
  return candidates;
}

}  // namespace plumb

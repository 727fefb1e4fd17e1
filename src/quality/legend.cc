// SPDX-FileCopyrightText: 2026 The Plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "plumbline/quality/legend.h"

#include <cmath>
#include <opencv2/imgproc.hpp>
#include <string>
#include <vector>

namespace plumb {
namespace {

constexpr int kLeft_px = 40;
constexpr int kRight_px = kLegendWidth_px - 165;  // Then the field of unseen faces.
constexpr int kTop_px = 60;
constexpr int kBottom_px = 112;
constexpr int kTicks_px = 142;  // The middle of their numbers.

// Sizes of letters. The panel shows the picture half as large: there they are 16 px, as the others.
constexpr double kText = 1.1;
constexpr double kSmallText = 0.95;

const cv::Scalar kInk(20, 20, 20);

struct LegendText {
  std::string title;
  std::vector<double> ticks;  // From poor to good.
};

LegendText TextOf(Layer layer, bool is_metric) {
  switch (layer) {
    case Layer::kGsd:
      if (is_metric) return {"GSD [mm per pixel]: blue coarse, red fine", {10, 5, 3, 2, 1}};
      return {"NOT METRIC YET: GSD, x the first photos'", {3, 2, 1, 0.5, 0.3}};
    case Layer::kRedundancy:
      return {"Cameras that see it: blue few, red many", {1, 2, 3, 5, 10, 20, 30}};
    case Layer::kAccuracy:
      if (is_metric)
        return {"Standard deviation [mm]: blue poor, red good", {20, 10, 5, 2, 1, 0.5}};
      return {"NOT METRIC YET: accuracy, px of the first photos", {10, 3, 1, 0.3, 0.1}};
    case Layer::kPlain:
      return {"Shape only", {}};
  }
  return {};
}

void Write(const std::string& text, cv::Point middle, double size, cv::Mat* picture) {
  const int thickness = 3;
  const cv::Size box = cv::getTextSize(text, cv::FONT_HERSHEY_SIMPLEX, size, thickness, nullptr);
  cv::putText(*picture,
              text,
              {middle.x - box.width / 2, middle.y + box.height / 2},
              cv::FONT_HERSHEY_SIMPLEX,
              size,
              kInk,
              thickness,
              cv::LINE_AA);
}

int ColumnOf(double place) {
  return kLeft_px + static_cast<int>(std::lround(place * (kRight_px - kLeft_px)));
}

std::string NumberText(double value) {
  std::string text = value < 1.0 ? cv::format("%.1f", value) : cv::format("%.0f", value);
  return text;
}

void DrawBar(Palette palette, cv::Mat* picture) {
  for (int column = kLeft_px; column < kRight_px; ++column) {
    const double place = (column - kLeft_px) / static_cast<double>(kRight_px - kLeft_px);
    const Rgb color = ColorAt(palette, place);
    picture->col(column)
        .rowRange(kTop_px, kBottom_px)
        .setTo(cv::Scalar(color[0], color[1], color[2]));
  }
  cv::rectangle(*picture, {kLeft_px, kTop_px}, {kRight_px, kBottom_px}, kInk, 2);
  const cv::Rect unseen(kLegendWidth_px - 102, kTop_px, 70, kBottom_px - kTop_px);
  const Rgb color = UnseenColor(palette);
  cv::rectangle(*picture, unseen, cv::Scalar(color[0], color[1], color[2]), cv::FILLED);
  cv::rectangle(*picture, unseen, kInk, 2);
  Write("unseen", {unseen.x + unseen.width / 2, kTicks_px}, kSmallText, picture);
}

void DrawWanted(double place, cv::Mat* picture) {
  const int column = ColumnOf(place);
  const std::vector<cv::Point> arrow = {
      {column - 12, kTop_px - 12}, {column + 12, kTop_px - 12}, {column, kTop_px + 10}};
  cv::fillConvexPoly(*picture, arrow, kInk, cv::LINE_AA);
  cv::line(*picture, {column, kTop_px}, {column, kBottom_px}, kInk, 3);
}

}  // namespace

cv::Mat DrawLegend(Layer layer,
                   Palette palette,
                   const Measure& measure,
                   const GapOptions& options) {
  const bool is_metric = measure.metres_per_map_unit.has_value();
  LegendText text = TextOf(layer, is_metric);
  cv::Mat picture(kLegendHeight_px, kLegendWidth_px, CV_8UC3, cv::Scalar::all(255));
  if (layer == Layer::kPlain) {
    Write(text.title, {kLegendWidth_px / 2, kLegendHeight_px / 2}, kText, &picture);
    return picture;
  }
  const Scale scale = ScaleOf(layer, is_metric);
  DrawBar(palette, &picture);
  for (const double tick : text.ticks) {
    const int column = ColumnOf(PlaceOnScale(scale, tick));
    cv::line(picture, {column, kBottom_px}, {column, kBottom_px + 8}, kInk, 2);
    Write(NumberText(tick), {column, kTicks_px}, kText, &picture);
  }
  const std::size_t red = text.title.find(", red ");
  if (palette == Palette::kColorBlind && red != std::string::npos) {
    text.title.replace(red, 6, ", yellow ");
  }
  if (layer == Layer::kGsd) {
    DrawWanted(PlaceOnScale(scale, WantedGsd(options, measure)), &picture);
  }
  Write(text.title, {kLegendWidth_px / 2, 24}, kText, &picture);
  return picture;
}

}  // namespace plumb

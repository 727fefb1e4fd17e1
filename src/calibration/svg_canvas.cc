// SPDX-FileCopyrightText: 2026 The Plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "calibration/svg_canvas.h"

#include <cairo-svg.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace plumb {

Color HeatColor(double share) {
  constexpr Color kStops[] = {
      {1.0, 1.0, 1.0}, {0.97, 0.89, 0.55}, {0.40, 0.70, 0.38}, {0.0, 0.36, 0.2}};
  const double place = 3.0 * std::clamp(share, 0.0, 1.0);
  const int low = std::min(2, static_cast<int>(place));
  const double along = place - low;
  const Color& a = kStops[low];
  const Color& b = kStops[low + 1];
  const auto mix = [along](double from, double to) { return from + along * (to - from); };
  return {mix(a.red, b.red), mix(a.green, b.green), mix(a.blue, b.blue)};
}

cairo_status_t SvgCanvas::Append(void* closure, const unsigned char* data, unsigned int length) {
  static_cast<std::string*>(closure)->append(reinterpret_cast<const char*>(data), length);
  return CAIRO_STATUS_SUCCESS;
}

SvgCanvas::SvgCanvas(double width, double height)
    : surface_(cairo_svg_surface_create_for_stream(Append, &bytes_, width, height),
               cairo_surface_destroy),
      cairo_(cairo_create(surface_.get()), cairo_destroy) {
  cairo_set_line_cap(cairo_.get(), CAIRO_LINE_CAP_ROUND);
  cairo_set_line_join(cairo_.get(), CAIRO_LINE_JOIN_ROUND);
  Rectangle({0.0, 0.0}, {width, height}, {1.0, 1.0, 1.0});
}

void SvgCanvas::SetColor(const Color& color) {
  cairo_set_source_rgb(cairo_.get(), color.red, color.green, color.blue);
}

void SvgCanvas::Line(const Eigen::Vector2d& from,
                     const Eigen::Vector2d& to,
                     const Color& color,
                     double width) {
  Polyline({from, to}, color, width);
}

void SvgCanvas::Polyline(const std::vector<Eigen::Vector2d>& points,
                         const Color& color,
                         double width) {
  SetColor(color);
  cairo_set_line_width(cairo_.get(), width);
  cairo_new_path(cairo_.get());
  for (const Eigen::Vector2d& point : points) cairo_line_to(cairo_.get(), point.x(), point.y());
  cairo_stroke(cairo_.get());
}

void SvgCanvas::Rectangle(const Eigen::Vector2d& corner,
                          const Eigen::Vector2d& size,
                          const Color& fill) {
  SetColor(fill);
  cairo_rectangle(cairo_.get(), corner.x(), corner.y(), size.x(), size.y());
  cairo_fill(cairo_.get());
}

void SvgCanvas::Frame(const Eigen::Vector2d& corner, const Eigen::Vector2d& size) {
  SetColor({0.5, 0.5, 0.5});
  cairo_set_line_width(cairo_.get(), 0.7);
  cairo_rectangle(cairo_.get(), corner.x(), corner.y(), size.x(), size.y());
  cairo_stroke(cairo_.get());
}

void SvgCanvas::Circle(const Eigen::Vector2d& center,
                       double radius,
                       const Color& color,
                       bool is_filled) {
  SetColor(color);
  cairo_set_line_width(cairo_.get(), 1.0);
  cairo_new_path(cairo_.get());
  cairo_arc(cairo_.get(), center.x(), center.y(), radius, 0.0, 2.0 * M_PI);
  is_filled ? cairo_fill(cairo_.get()) : cairo_stroke(cairo_.get());
}

void SvgCanvas::Text(const Eigen::Vector2d& at,
                     const std::string& text,
                     double size,
                     int align,
                     const Color& color) {
  SetColor(color);
  cairo_select_font_face(cairo_.get(), "sans", CAIRO_FONT_SLANT_NORMAL, CAIRO_FONT_WEIGHT_NORMAL);
  cairo_set_font_size(cairo_.get(), size);
  cairo_text_extents_t extents;
  cairo_text_extents(cairo_.get(), text.c_str(), &extents);
  cairo_move_to(cairo_.get(), at.x() - 0.5 * (align + 1) * extents.x_advance, at.y());
  cairo_show_text(cairo_.get(), text.c_str());
  cairo_new_path(cairo_.get());
}

std::string SvgCanvas::Finish() {
  cairo_surface_finish(surface_.get());
  const cairo_status_t status = cairo_surface_status(surface_.get());
  if (status != CAIRO_STATUS_SUCCESS) {
    throw std::runtime_error(std::string("an SVG picture cannot be drawn: ") +
                             cairo_status_to_string(status));
  }
  return bytes_;
}

}  // namespace plumb

// SPDX-FileCopyrightText: 2026 The Plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cairo.h>

#include <Eigen/Core>
#include <memory>
#include <string>
#include <vector>

namespace plumb {

struct Color {
  double red = 0.0;
  double green = 0.0;
  double blue = 0.0;
};

// From white over yellow to dark green, for a share in 0..1; readable with any colour vision.
Color HeatColor(double share);

// An SVG picture with a white ground, drawn with Cairo. Lengths in points, y down.
class SvgCanvas {
 public:
  SvgCanvas(double width, double height);

  void Line(const Eigen::Vector2d& from,
            const Eigen::Vector2d& to,
            const Color& color,
            double width = 1.0);
  void Polyline(const std::vector<Eigen::Vector2d>& points, const Color& color, double width = 1.5);
  void Rectangle(const Eigen::Vector2d& corner, const Eigen::Vector2d& size, const Color& fill);
  void Frame(const Eigen::Vector2d& corner, const Eigen::Vector2d& size);
  void Circle(const Eigen::Vector2d& center, double radius, const Color& color, bool is_filled);

  // `at` is the text's base line: its left end (-1), middle (0) or right end (1).
  void Text(const Eigen::Vector2d& at,
            const std::string& text,
            double size,
            int align = -1,
            const Color& color = {0.15, 0.15, 0.15});

  // The whole file. Throws std::runtime_error if Cairo failed. Nothing may be drawn after it.
  std::string Finish();

 private:
  static cairo_status_t Append(void* closure, const unsigned char* data, unsigned int length);
  void SetColor(const Color& color);

  std::string bytes_;
  std::unique_ptr<cairo_surface_t, decltype(&cairo_surface_destroy)> surface_;
  std::unique_ptr<cairo_t, decltype(&cairo_destroy)> cairo_;
};

}  // namespace plumb

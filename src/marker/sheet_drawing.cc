// SPDX-FileCopyrightText: 2026 The Plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include <cairo-pdf.h>
#include <cairo-svg.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <memory>
#include <stdexcept>

#include "plumbline/common/atomic_file.h"
#include "plumbline/marker/codebook.h"
#include "plumbline/marker/marker_layout.h"
#include "plumbline/marker/marker_sheet.h"

namespace plumb {
namespace {

constexpr double kPointsPerMm = 72.0 / 25.4;
constexpr double kTextMm = 3.5;
constexpr double kLineMm = 0.2;
constexpr double kFooterMm = 12.0;  // From the page's lower edge to the scale bar.

using Surface = std::unique_ptr<cairo_surface_t, decltype(&cairo_surface_destroy)>;
using Context = std::unique_ptr<cairo_t, decltype(&cairo_destroy)>;

cairo_status_t AppendBytes(void* closure, const unsigned char* data, unsigned int length) {
  static_cast<std::string*>(closure)->append(reinterpret_cast<const char*>(data), length);
  return CAIRO_STATUS_SUCCESS;
}

void SetGray(cairo_t* cairo, double gray) { cairo_set_source_rgb(cairo, gray, gray, gray); }

void FillCircle(cairo_t* cairo, double radius) {
  cairo_new_path(cairo);
  cairo_arc(cairo, 0.0, 0.0, radius, 0.0, 2.0 * M_PI);
  cairo_fill(cairo);
}

// White cells side by side are one piece, so that no seam shows.
void FillCode(cairo_t* cairo, std::uint32_t word) {
  const auto is_white = [word](int cell) { return ((word >> (cell % kNumCodeBits)) & 1) != 0; };
  constexpr double kCellRad = 2.0 * M_PI / kNumCodeBits;
  for (int first = 0; first < kNumCodeBits; ++first) {
    if (!is_white(first) || is_white(first + kNumCodeBits - 1)) continue;
    int end = first + 1;
    while (is_white(end)) ++end;
    cairo_new_path(cairo);
    cairo_arc(cairo, 0.0, 0.0, kStripeOuterRadius, first * kCellRad, end * kCellRad);
    cairo_arc_negative(cairo, 0.0, 0.0, kStripeInnerRadius, end * kCellRad, first * kCellRad);
    cairo_fill(cairo);
  }
}

void DrawCross(cairo_t* cairo) {
  cairo_new_path(cairo);
  cairo_set_line_width(cairo, kCrossRadius / 8.0);
  for (const auto& [x, y] : {std::pair(kCrossRadius, 0.0), std::pair(0.0, kCrossRadius)}) {
    cairo_move_to(cairo, -x, -y);
    cairo_line_to(cairo, x, y);
  }
  cairo_stroke(cairo);
}

void DrawFace(cairo_t* cairo, const PrintedMarker& marker, double radius_mm) {
  const std::uint32_t word = MarkerCodebook::Get().Word(marker.id);
  cairo_save(cairo);
  cairo_translate(cairo, marker.center_mm.x(), marker.center_mm.y());
  cairo_scale(cairo, radius_mm, radius_mm);
  SetGray(cairo, 0.0);
  FillCircle(cairo, 1.0);
  SetGray(cairo, 1.0);
  FillCode(cairo, word);
  FillCircle(cairo, kDiscRadius);
  SetGray(cairo, 0.0);
  DrawCross(cairo);
  cairo_restore(cairo);
}

void DrawText(cairo_t* cairo,
              const Eigen::Vector2d& at_mm,
              double size_mm,
              const std::string& text) {
  SetGray(cairo, 0.0);
  cairo_select_font_face(cairo, "sans", CAIRO_FONT_SLANT_NORMAL, CAIRO_FONT_WEIGHT_NORMAL);
  cairo_set_font_size(cairo, size_mm);
  cairo_move_to(cairo, at_mm.x(), at_mm.y());
  cairo_show_text(cairo, text.c_str());
  cairo_new_path(cairo);
}

// The number in the cell's lower left corner, outside the quiet zone.
void DrawNumber(cairo_t* cairo, const MarkerSheet& sheet, const PrintedMarker& marker) {
  const double corner_mm = 0.5 * sheet.cell_mm;
  const double size_mm = 0.08 * sheet.cell_mm;
  DrawText(cairo,
           marker.center_mm + Eigen::Vector2d(-0.95 * corner_mm, 0.95 * corner_mm),
           size_mm,
           std::to_string(marker.id));
}

void DrawCutLines(cairo_t* cairo, const MarkerSheet& sheet, const PrintedMarker& marker) {
  const double dash_mm = 2.0;
  cairo_set_dash(cairo, &dash_mm, 1, 0.0);
  cairo_set_line_width(cairo, kLineMm);
  SetGray(cairo, 0.6);
  cairo_rectangle(cairo,
                  marker.center_mm.x() - 0.5 * sheet.cell_mm,
                  marker.center_mm.y() - 0.5 * sheet.cell_mm,
                  sheet.cell_mm,
                  sheet.cell_mm);
  cairo_stroke(cairo);
  cairo_set_dash(cairo, nullptr, 0, 0.0);
}

// A bar with ticks at its tenths, and what to do with it.
void DrawScaleBar(cairo_t* cairo, const MarkerSheet& sheet) {
  const double left_mm = 0.5 * (sheet.page_mm.x() - sheet.scale_bar_mm);
  const double y_mm = sheet.page_mm.y() - kFooterMm + 2.0;
  SetGray(cairo, 0.0);
  cairo_set_line_width(cairo, kLineMm);
  cairo_move_to(cairo, left_mm, y_mm);
  cairo_line_to(cairo, left_mm + sheet.scale_bar_mm, y_mm);
  for (int i = 0; i <= 10; ++i) {
    const double x_mm = left_mm + 0.1 * i * sheet.scale_bar_mm;
    cairo_move_to(cairo, x_mm, y_mm);
    cairo_line_to(cairo, x_mm, y_mm - (i % 10 == 0 ? 3.0 : 1.5));
  }
  cairo_stroke(cairo);
  const std::string length = std::to_string(std::lround(sheet.scale_bar_mm));
  const std::string advice =
      length + " mm. If it measures otherwise, print at 100 % without fitting to the page.";
  const double size_mm = std::min(kTextMm, sheet.scale_bar_mm / 40.0);
  DrawText(cairo, {left_mm, y_mm + 1.5 * size_mm}, size_mm, advice);
}

void DrawPage(cairo_t* cairo, const MarkerSheet& sheet, int page) {
  cairo_save(cairo);
  cairo_scale(cairo, kPointsPerMm, kPointsPerMm);
  SetGray(cairo, 1.0);
  cairo_paint(cairo);
  for (const PrintedMarker& marker : sheet.markers) {
    if (marker.page != page) continue;
    DrawFace(cairo, marker, 0.5 * sheet.diameter_mm);
    DrawNumber(cairo, sheet, marker);
    if (sheet.has_cut_lines) DrawCutLines(cairo, sheet, marker);
  }
  const bool has_header = sheet.markers.size() > 1;  // A target's page has no room for one.
  if (has_header) DrawText(cairo, {12.0, 16.0}, kTextMm, sheet.title);
  DrawScaleBar(cairo, sheet);
  cairo_restore(cairo);
  cairo_show_page(cairo);
}

void Check(cairo_status_t status, const std::string& path) {
  if (status == CAIRO_STATUS_SUCCESS) return;
  throw std::runtime_error(path + ": cannot be drawn: " + cairo_status_to_string(status));
}

void WritePages(
    const MarkerSheet& sheet, int first, int end, bool is_pdf, const std::string& path) {
  std::string bytes;
  const double width = sheet.page_mm.x() * kPointsPerMm;
  const double height = sheet.page_mm.y() * kPointsPerMm;
  const Surface surface(
      is_pdf ? cairo_pdf_surface_create_for_stream(AppendBytes, &bytes, width, height)
             : cairo_svg_surface_create_for_stream(AppendBytes, &bytes, width, height),
      cairo_surface_destroy);
  if (is_pdf) {
    cairo_pdf_surface_set_metadata(surface.get(), CAIRO_PDF_METADATA_TITLE, sheet.title.c_str());
  }
  const Context context(cairo_create(surface.get()), cairo_destroy);
  for (int page = first; page < end; ++page) DrawPage(context.get(), sheet, page);
  Check(cairo_status(context.get()), path);
  cairo_surface_finish(surface.get());
  Check(cairo_surface_status(surface.get()), path);
  WriteFileAtomically(path, bytes);
}

}  // namespace

std::vector<std::string> WriteMarkerSheet(const MarkerSheet& sheet, const std::string& path) {
  const std::filesystem::path file(path);
  const bool is_pdf = file.extension() == ".pdf";
  if (!is_pdf && file.extension() != ".svg") {
    throw std::runtime_error(path + ": is neither a PDF nor an SVG; end its name in .pdf or .svg");
  }
  if (is_pdf || sheet.num_pages == 1) {
    WritePages(sheet, 0, sheet.num_pages, is_pdf, path);
    return {path};
  }
  std::vector<std::string> paths;  // An SVG has one page.
  for (int page = 0; page < sheet.num_pages; ++page) {
    std::filesystem::path of_page = file;
    of_page.replace_filename(file.stem().string() + '_' + std::to_string(page + 1) + ".svg");
    WritePages(sheet, page, page + 1, false, of_page.string());
    paths.push_back(of_page.string());
  }
  return paths;
}

}  // namespace plumb

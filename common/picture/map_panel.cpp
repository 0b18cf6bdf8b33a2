// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "common/picture/map_panel.hpp"

#include <algorithm>

#include "common/picture/legend.hpp"
#include "common/picture/palette.hpp"

namespace adit {
namespace {

constexpr double kTitle = 26.0;  // height of the title line
constexpr double kTitleText = 17.0;
constexpr double kScale = 44.0;  // height of the row of the scale bar
constexpr double kHigherThanWide = 1.5;
constexpr double kNarrow = 300.0;  // narrower panels have smaller letters

}  // namespace

MapPanel::MapPanel(const Canvas& canvas, const TerrainMap& terrain, double left, double top,
                   double width)
    : canvas_(canvas),
      terrain_(terrain),
      left_(left),
      top_(top + kTitle),
      width_(width),
      cell_px_(std::min(width / terrain.cells.columns(),
                        kHigherThanWide * width / terrain.cells.rows())) {}

Eigen::Vector2d MapPanel::pixel(const Eigen::Vector2d& p_level) const {
  const Eigen::Vector2d p = (p_level - terrain_.p_level_corner) / terrain_.cell_m;
  return {left_ + p.x() * cell_px_, top_ + (terrain_.cells.rows() - p.y()) * cell_px_};
}

double MapPanel::bottom() const { return top_ + terrain_.cells.rows() * cell_px_; }

void MapPanel::draw(const RgbImage& image, const std::string& title) const {
  const double width = terrain_.cells.columns() * cell_px_;
  const double height = terrain_.cells.rows() * cell_px_;
  canvas_.colour(kInk);
  canvas_.text(title, left_, top_ - 9.0, width_ < kNarrow ? 0.85 * kTitleText : kTitleText, false,
               Align::kLeft);
  canvas_.fill_rectangle(left_ - 1.0, top_ - 1.0, width + 2.0, height + 2.0);
  canvas_.image(image, left_, top_, width, height);
}

void MapPanel::outline(const Pose2& T_level_body, const ConvexPolygon& outline) const {
  cairo_new_path(canvas_.cairo());  // drawing text leaves a current point
  for (const Eigen::Vector2d& corner : outline.corners()) {
    const Eigen::Vector2d at = pixel(T_level_body * corner);
    cairo_line_to(canvas_.cairo(), at.x(), at.y());
  }
  cairo_close_path(canvas_.cairo());
  cairo_stroke(canvas_.cairo());
}

void MapPanel::draw_vehicle(const Pose2& T_level_body, const ConvexPolygon& outline) const {
  for (const auto& [colour, width] : {std::pair(kOpen, 4.0), std::pair(kStart, 2.0)}) {
    canvas_.colour(colour);
    cairo_set_line_width(canvas_.cairo(), width_ < kNarrow ? width / 2.0 : width);
    this->outline(T_level_body, outline);
  }
  const Eigen::Vector2d& half = outline.high();
  for (const Eigen::Vector2d& corner :
       {Eigen::Vector2d(0.8 * half.x(), 0.0), Eigen::Vector2d(0.0, 0.7 * half.y()),
        Eigen::Vector2d(0.0, -0.7 * half.y())}) {
    const Eigen::Vector2d at = pixel(T_level_body * corner);
    cairo_line_to(canvas_.cairo(), at.x(), at.y());
  }
  cairo_fill(canvas_.cairo());
}

double MapPanel::finish(const Legend& legend) const {
  const double bar_m = scale_bar_m(width_ / pixels_per_metre() / 4.0);
  draw_scale_bar(canvas_, left_, bottom() + 14.0, bar_m, pixels_per_metre(), 1.0);
  return draw_legend(canvas_, legend, left_, bottom() + kScale + 6.0, width_);
}

void MapPanel::clip() const {
  cairo_save(canvas_.cairo());
  cairo_rectangle(canvas_.cairo(), left_, top_, terrain_.cells.columns() * cell_px_,
                  terrain_.cells.rows() * cell_px_);
  cairo_clip(canvas_.cairo());
}

void MapPanel::unclip() const { cairo_restore(canvas_.cairo()); }

}  // namespace adit

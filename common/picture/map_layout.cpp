// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "common/picture/map_layout.hpp"

#include <algorithm>
#include <cmath>

#include "common/picture/legend.hpp"
#include "common/picture/palette.hpp"

namespace adit {
namespace {

constexpr int kPixelsMax = 2400;
constexpr int kLongSideDesired = 1600;  // lettering and lines are scaled up on larger sheets
constexpr double kPixelsPerMetreMax = 60.0;
constexpr int kWidthMin = 820;  // needed by the footer

}  // namespace

MapLayout::MapLayout(const OccupancyGrid& grid, const std::vector<Pose2>& poses, int keys)
    : cells(grid.observed_box()),
      low(grid.resolution_m() * cells.from.cast<double>()),
      high(grid.resolution_m() * cells.to.cast<double>()) {
  if (cells.empty()) low = high = poses.empty() ? Eigen::Vector2d(0, 0) : poses[0].translation();
  for (const Pose2& pose : poses) {
    low = low.cwiseMin(pose.translation());
    high = high.cwiseMax(pose.translation());
  }
  low -= Eigen::Vector2d::Constant(1.0);
  high += Eigen::Vector2d::Constant(1.0);
  const Eigen::Vector2d size = high - low;
  // A cell takes at least one pixel, up to the limit of the sheet.
  const double finest = 1.0 / grid.resolution_m();
  const double desired = std::max(finest, kLongSideDesired / size.maxCoeff());
  pixels_per_metre = std::min(desired, kPixelsPerMetreMax);
  unit = std::clamp(pixels_per_metre * size.maxCoeff() / kLongSideDesired, 1.0,
                    static_cast<double>(kPixelsMax) / kLongSideDesired);
  const Eigen::Vector2d around = unit * Eigen::Vector2d(2.0 * kPageMargin, kHeader + kFooter);
  pixels_per_metre = std::min({pixels_per_metre, (kPixelsMax - around.x()) / size.x(),
                               (kPixelsMax - around.y()) / size.y()});
  const Eigen::Vector2d map = pixels_per_metre * size;
  const int width_min = kWidthMin + static_cast<int>(keys * kGraphKey * unit);
  width = std::max(width_min, static_cast<int>(map.x() + around.x()));
  height = static_cast<int>(map.y() + around.y());
  left = (width - map.x()) / 2.0;
  top = unit * kHeader;
}

namespace {

void draw_marker(const Canvas& canvas, const Eigen::Vector2d& p, double radius,
                 const Colour& colour) {
  canvas.colour(kOpen);
  canvas.disc(p.x(), p.y(), 1.35 * radius);
  canvas.colour(colour);
  canvas.disc(p.x(), p.y(), radius);
}

void draw_path_key(const Canvas& canvas, double left, double right, double y, double unit) {
  const auto steps = static_cast<int>(right - left);
  for (int i = 0; i < steps; ++i) {
    canvas.colour(along_path(static_cast<double>(i) / steps));
    canvas.fill_rectangle(left + i, y - 2.0 * unit, 1.5, 4.0 * unit);
  }
  draw_start(canvas, {left, y}, unit);
  draw_end(canvas, {right, y}, unit);
  canvas.colour(kInk);
  canvas.text("start", left, y + 24.0 * unit, 15.0 * unit, false, Align::kCentre);
  canvas.text("end", right, y + 24.0 * unit, 15.0 * unit, false, Align::kCentre);
}

struct Band {
  Colour colour;
  const char* name;
};

void draw_band_key(const Canvas& canvas, const Band& band, double centre, double y, double unit) {
  canvas.colour(band.colour);
  canvas.fill_rectangle(centre - 30.0 * unit, y - 6.0 * unit, 60.0 * unit, 12.0 * unit);
  canvas.colour(kInk);
  canvas.text(band.name, centre, y + 24.0 * unit, 15.0 * unit, false, Align::kCentre);
}

}  // namespace

void draw_start(const Canvas& canvas, const Eigen::Vector2d& p, double unit) {
  draw_marker(canvas, p, 10.0 * unit, kStart);
}

void draw_end(const Canvas& canvas, const Eigen::Vector2d& p, double unit) {
  draw_marker(canvas, p, 5.5 * unit, kEnd);
}

void draw_scale_bar(const Canvas& canvas, const MapLayout& layout) {
  const double metres = scale_bar_m((layout.high.x() - layout.low.x()) / 5.0);
  draw_scale_bar(canvas, kPageMargin * layout.unit, foot(layout), metres, layout.pixels_per_metre,
                 layout.unit);
}

double draw_path_keys(const Canvas& canvas, const MapLayout& layout, bool with_degenerate,
                      bool with_doubtful) {
  const double y = foot(layout);
  const double right = layout.width - (kPageMargin + 8.0) * layout.unit;
  const double left = right - 180.0 * layout.unit;
  draw_path_key(canvas, left, right, y, layout.unit);
  if (!with_degenerate && !with_doubtful) return left - 40.0 * layout.unit;
  double centre = left - 120.0 * layout.unit;
  if (with_degenerate) draw_band_key(canvas, {kDegenerate, "degenerate"}, centre, y, layout.unit);
  if (!with_doubtful) return centre - 50.0 * layout.unit;
  if (with_degenerate) centre -= kGraphKey * layout.unit;
  draw_band_key(canvas, {kDoubtful, "doubtful"}, centre, y, layout.unit);
  return centre - 50.0 * layout.unit;
}

}  // namespace adit

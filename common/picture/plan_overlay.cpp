// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "common/picture/plan_overlay.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "common/picture/palette.hpp"
#include "common/picture/terrain_layer.hpp"

namespace adit {
namespace {

constexpr double kOutlineEveryM = 1.0;
constexpr double kGoalRadiusPx = 9.0;
constexpr Colour kReached = rgb(0x3fb56b);
constexpr double kReachedShare = 0.4;
constexpr Colour kGoal = rgb(0x0b5fff);

struct ReasonColour {
  Colour colour;
  const char* name;
};
/// In the order of BlockingCell::Reason, of which kDrop is the last.
constexpr std::array<ReasonColour, 7> kReasons = {{{rgb(0xff00b8), "a step"},
                                                   {rgb(0xe0182d), "too high to drive over"},
                                                   {rgb(0x7b1fa2), "the roof"},
                                                   {rgb(0xf2c200), "not seen"},
                                                   {rgb(0x1560bd), "water?"},
                                                   {rgb(0x7a4a21), "too steep"},
                                                   {rgb(0x008b8b), "a drop"}}};

static_assert(kReasons.size() == static_cast<std::size_t>(BlockingCell::Reason::kDrop) + 1);

const ReasonColour& reason_of(const BlockingCell& cell) {
  return kReasons[static_cast<std::size_t>(cell.reason)];
}

Pose2 in_level(const MapPanel& panel, const Pose2& T_odom) {
  return between(panel.terrain().T_odom_level, T_odom);
}

void draw_blocking(const MapPanel& panel, const PlannedPath& path) {
  const double side = std::max(panel.cell_px(), 3.0);
  for (const BlockingCell& cell : path.blocking) {
    const Eigen::Vector2d at = panel.pixel(panel.terrain().T_odom_level.inverse() * cell.p_odom);
    panel.canvas().colour(reason_of(cell).colour);
    panel.canvas().fill_rectangle(at.x() - side / 2.0, at.y() - side / 2.0, side, side);
  }
}

void draw_outlines(const MapPanel& panel, const PlanPicture& picture) {
  const auto& points = picture.path.points;
  cairo_set_line_width(panel.canvas().cairo(), 1.4);
  double way = kOutlineEveryM;
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (i > 0) {
      way += between(points[i - 1].T_odom_body, points[i].T_odom_body).translation().norm();
    }
    if (way < kOutlineEveryM && i + 1 < points.size()) continue;
    way = 0.0;
    panel.canvas().colour(along_path(static_cast<double>(i) / static_cast<double>(points.size())));
    panel.outline(in_level(panel, points[i].T_odom_body), picture.length_m, picture.width_m);
  }
}

/// A ring at a pose; a dashed line to as far as the robot is to get.
void draw_goal(const MapPanel& panel, const PlanGoal& goal) {
  cairo_t* const cairo = panel.canvas().cairo();
  const Pose2 T_level_goal = in_level(panel, goal.T_odom_goal);
  const double ahead_m = goal.kind == PlanGoal::Kind::kAlong ? goal.distance_m : 0.0;
  const Eigen::Vector2d from = panel.pixel(T_level_goal.translation());
  const Eigen::Vector2d to = panel.pixel(T_level_goal * Eigen::Vector2d(ahead_m, 0.0));
  panel.canvas().colour(kGoal);
  cairo_set_line_width(cairo, 2.0);
  if (ahead_m > 0.0) {
    const std::array<double, 2> dashes{4.0, 6.0};
    cairo_set_dash(cairo, dashes.data(), 2, 0.0);
    cairo_move_to(cairo, from.x(), from.y());
    cairo_line_to(cairo, to.x(), to.y());
    cairo_stroke(cairo);
    cairo_set_dash(cairo, nullptr, 0, 0.0);
  }
  cairo_new_path(cairo);
  cairo_arc(cairo, to.x(), to.y(), kGoalRadiusPx, 0.0, 6.3);
  cairo_stroke(cairo);
}

void tint(RgbImage::Pixel& pixel) {
  const Colour was{pixel[0] / 255.0, pixel[1] / 255.0, pixel[2] / 255.0};
  pixel = rgb_pixel(blend(was, kReached, kReachedShare));
}

}  // namespace

RgbImage reached_image(const PlanPicture& picture) {
  RgbImage image = terrain_image(picture.terrain);
  if (picture.reached.size() != picture.terrain.cells.size()) return image;
  for (std::size_t i = 0; i < picture.reached.size(); ++i) {
    if (picture.reached[i] == 0) continue;
    const int row = static_cast<int>(i) / image.width;
    tint(image.at(static_cast<int>(i) % image.width, image.height - 1 - row));
  }
  return image;
}

void draw_way(const MapPanel& panel, const PlannedPath& path) {
  panel.canvas().colour(kStart);
  const double radius = std::clamp(panel.cell_px() / 2.0, 1.0, 2.0);
  for (const PathPoint& point : path.points) {
    const Eigen::Vector2d at = panel.pixel(in_level(panel, point.T_odom_body).translation());
    panel.canvas().disc(at.x(), at.y(), radius);
  }
}

void draw_plan(const MapPanel& panel, const PlanPicture& picture) {
  panel.clip();
  if (picture.goal) draw_goal(panel, *picture.goal);
  draw_outlines(panel, picture);
  draw_way(panel, picture.path);
  draw_blocking(panel, picture.path);
  panel.draw_vehicle({}, picture.length_m, picture.width_m);
  panel.unclip();
}

Legend plan_legend(const PlanPicture& picture) {
  Legend legend{{kStart, "the robot", {}}};
  if (picture.goal) legend.push_back({kGoal, "where it is to go", {}});
  if (!picture.path.points.empty()) {
    legend.push_back({along_path(0.0), "outline along the path", along_path(1.0)});
  }
  if (!picture.reached.empty()) {
    legend.push_back({kReached, "where its middle can get", {}});
  }
  std::array<bool, kReasons.size()> named{};
  for (const BlockingCell& cell : picture.path.blocking) {
    bool& done = named[static_cast<std::size_t>(cell.reason)];
    if (!done)
      legend.push_back(
          {reason_of(cell).colour, std::string("in the way: ") + reason_of(cell).name, {}});
    done = true;
  }
  return legend;
}

}  // namespace adit

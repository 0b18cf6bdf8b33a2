// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "sim/view/plan_marks.hpp"

#include <cmath>
#include <numbers>

#include "common/picture/map_keys.hpp"
#include "common/picture/palette.hpp"

namespace adit {
namespace {

constexpr Colour kGas = rgb(0xd08a00);
constexpr double kArrow = 16.0;  // length [pixels]

/// A triangle on the place, its tip to where the heading goes.
void draw_arrow(const Canvas& canvas, const Eigen::Vector2d& p, double heading_rad) {
  const Eigen::Vector2d ahead(std::cos(heading_rad), -std::sin(heading_rad));  // v points down
  const Eigen::Vector2d aside(-ahead.y(), ahead.x());
  cairo_t* cairo = canvas.cairo();
  cairo_new_path(cairo);
  for (const Eigen::Vector2d& corner :
       {Eigen::Vector2d(p + kArrow * ahead), Eigen::Vector2d(p - 0.35 * kArrow * aside),
        Eigen::Vector2d(p + 0.35 * kArrow * aside)}) {
    cairo_line_to(cairo, corner.x(), corner.y());
  }
  cairo_close_path(cairo);
  canvas.colour(kEnd);
  cairo_fill_preserve(cairo);
  canvas.colour(kOpen);
  cairo_set_line_width(cairo, 1.5);
  cairo_stroke(cairo);
}

void draw_gas(const Canvas& canvas, const Eigen::Vector2d& p, double radius) {
  canvas.colour(kGas);
  cairo_set_line_width(canvas.cairo(), 2.0);
  cairo_new_path(canvas.cairo());
  cairo_arc(canvas.cairo(), p.x(), p.y(), radius, 0.0, 2.0 * std::numbers::pi);
  cairo_stroke(canvas.cairo());
  canvas.text("gas", p.x(), p.y() + 5.0, 14.0, true, Align::kCentre);
}

}  // namespace

void draw_plan_marks(const Canvas& canvas, const PlanWindow& window, const Eigen::Vector2i& corner,
                     const World& world, const Pose2& T_world_camera) {
  cairo_save(canvas.cairo());
  cairo_rectangle(canvas.cairo(), corner.x(), corner.y(), window.width(), window.height());
  cairo_clip(canvas.cairo());
  const auto on_sheet = [&](const Eigen::Vector2d& p_world) -> Eigen::Vector2d {
    return window.pixel(p_world) + corner.cast<double>();
  };
  for (const GasPocket& gas : world.gas) {
    draw_gas(canvas, on_sheet(gas.p_world), gas.radius_m * window.pixels_per_metre);
  }
  draw_arrow(canvas, on_sheet(T_world_camera.translation()), T_world_camera.theta);
  draw_start(canvas, on_sheet(world.T_world_start.translation()), 0.7);
  cairo_restore(canvas.cairo());
}

}  // namespace adit

// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "tools/check_robot/robot_picture.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

#include <cairo.h>
#include <fmt/format.h>

#include "common/picture/canvas.hpp"
#include "common/picture/legend.hpp"
#include "common/picture/palette.hpp"
#include "common/types/body_outline.hpp"
#include "tools/check_robot/abilities.hpp"
#include "tools/check_robot/field_of_view.hpp"

namespace adit {
namespace {

constexpr double kWidth = 900.0;   // of the sheet [pixels]
constexpr double kHeight = 620.0;  // of the plan
constexpr double kTitle = 44.0;    // above the plan
constexpr double kAroundM = 1.2;   // shown around the body, at least
constexpr int kBlockPixels = 4;    // of an area that is seen or not
constexpr Colour kBlind = rgb(0xdea6ab);
constexpr Colour kSeen = rgb(0xd9efe0);
constexpr Colour kBody = rgb(0xffffff);
constexpr Colour kWheel = rgb(0x555a61);
constexpr Colour kStop = rgb(0xf07800);
constexpr double kBlindShownM = 1.0;  // from the body

/// Body coordinates to pixels: x to the right, y up.
struct Plan {
  double left;
  double top;
  double pixels_per_m;

  [[nodiscard]] double u(double x) const { return left + 0.5 * kWidth + x * pixels_per_m; }
  [[nodiscard]] double v(double y) const { return top + 0.5 * kHeight - y * pixels_per_m; }
  [[nodiscard]] Eigen::Vector2d p_body(double u_px, double v_px) const {
    return {(u_px - left - 0.5 * kWidth) / pixels_per_m,
            (top + 0.5 * kHeight - v_px) / pixels_per_m};
  }
};

void draw_view(const Canvas& canvas, const Plan& plan, const RobotConfig& robot) {
  const std::vector<NamedLaser> lasers = lasers_of(robot.lasers);
  const ConvexPolygon outline = body_outline(robot.vehicle);
  for (int row = 0; row * kBlockPixels < kHeight; ++row) {
    for (int column = 0; column * kBlockPixels < kWidth; ++column) {
      const double u = plan.left + column * kBlockPixels;
      const double v = plan.top + row * kBlockPixels;
      const Eigen::Vector2d p = plan.p_body(u + 0.5 * kBlockPixels, v + 0.5 * kBlockPixels);
      const bool seen = std::ranges::any_of(
          lasers, [&](const NamedLaser& laser) { return sees(laser.mount, robot.vehicle, p); });
      const bool near = outline.distance_m(p) <= kBlindShownM;
      if (!seen && !near) continue;
      canvas.colour(seen ? kSeen : kBlind);
      canvas.fill_rectangle(u, v, kBlockPixels, kBlockPixels);
    }
  }
}

void fill_box(const Canvas& canvas, const Plan& plan, const Eigen::Vector2d& middle,
              const Eigen::Vector2d& size) {
  canvas.fill_rectangle(plan.u(middle.x() - 0.5 * size.x()), plan.v(middle.y() + 0.5 * size.y()),
                        size.x() * plan.pixels_per_m, size.y() * plan.pixels_per_m);
}

void outline_box(const Canvas& canvas, const Plan& plan, const Eigen::Vector2d& middle,
                 const Eigen::Vector2d& size) {
  cairo_rectangle(canvas.cairo(), plan.u(middle.x() - 0.5 * size.x()),
                  plan.v(middle.y() + 0.5 * size.y()), size.x() * plan.pixels_per_m,
                  size.y() * plan.pixels_per_m);
  cairo_set_line_width(canvas.cairo(), 2.0);
  cairo_stroke(canvas.cairo());
}

void trace(const Canvas& canvas, const Plan& plan, const ConvexPolygon& polygon) {
  cairo_new_path(canvas.cairo());  // drawing text leaves a current point
  for (const Eigen::Vector2d& corner : polygon.corners())
    cairo_line_to(canvas.cairo(), plan.u(corner.x()), plan.v(corner.y()));
  cairo_close_path(canvas.cairo());
}

void draw_body(const Canvas& canvas, const Plan& plan, const Vehicle& vehicle) {
  canvas.colour(kBody);
  trace(canvas, plan, body_outline(vehicle));
  cairo_fill(canvas.cairo());
  canvas.colour(kWheel);
  for (const double x : {-0.5, 0.5}) {
    for (const double y : {-0.5, 0.5}) {
      fill_box(canvas, plan, {x * vehicle.wheelbase_m, y * vehicle.track_m},
               {2.0 * vehicle.wheel_radius_m, vehicle.wheel_width_m});
    }
  }
  canvas.colour(kInk);
  trace(canvas, plan, body_outline(vehicle));
  cairo_set_line_width(canvas.cairo(), 2.0);
  cairo_stroke(canvas.cairo());
}

void draw_laser(const Canvas& canvas, const Plan& plan, const NamedLaser& laser) {
  const Pose2& pose = laser.mount.T_body_laser;
  canvas.colour(kJunctionMark);
  canvas.disc(plan.u(pose.x), plan.v(pose.y), 7.0);
  for (const double share : {-0.5, 0.0, 0.5}) {
    const double bearing = pose.theta + share * laser.mount.field_of_view_rad;
    const double length_m = share == 0.0 ? 0.5 : 0.8;
    cairo_move_to(canvas.cairo(), plan.u(pose.x), plan.v(pose.y));
    cairo_line_to(canvas.cairo(), plan.u(pose.x + length_m * std::cos(bearing)),
                  plan.v(pose.y + length_m * std::sin(bearing)));
  }
  cairo_set_line_width(canvas.cairo(), 1.5);
  cairo_stroke(canvas.cairo());
  canvas.text(laser.name, plan.u(pose.x) + 10.0, plan.v(pose.y) - 10.0, 15.0, true, Align::kLeft);
}

void draw_stopping(const Canvas& canvas, const Plan& plan, const RobotConfig& robot) {
  const double stop_m = abilities_of(robot).stopping_m;
  canvas.colour(kStop);
  for (const double side : {1.0, -1.0}) {
    outline_box(canvas, plan, {side * 0.5 * (robot.vehicle.length_m + stop_m), 0.0},
                {stop_m, robot.vehicle.width_m});
  }
}

}  // namespace

void write_robot_png(const std::filesystem::path& path, const std::string& title,
                     const RobotConfig& robot) {
  const double stop_m = abilities_of(robot).stopping_m;
  const double half_x = 0.5 * robot.vehicle.length_m + std::max(kAroundM, stop_m + 0.2);
  const double half_y = 0.5 * robot.vehicle.width_m + kAroundM;
  const double pixels_per_m = std::min(0.5 * kWidth / half_x, 0.5 * kHeight / half_y);
  write_sheet(path, kWidth, [&](const Canvas& canvas, double left, double top) {
    canvas.colour(kInk);
    canvas.text(title, left, top + 22.0, 22.0, true, Align::kLeft);
    const Plan plan{left, top + kTitle, pixels_per_m};
    canvas.colour(kPaper);
    canvas.fill_rectangle(left, plan.top, kWidth, kHeight);
    draw_view(canvas, plan, robot);
    draw_body(canvas, plan, robot.vehicle);
    draw_stopping(canvas, plan, robot);
    for (const NamedLaser& laser : lasers_of(robot.lasers)) draw_laser(canvas, plan, laser);
    const double bar_m = scale_bar_m(0.25 * kWidth / pixels_per_m);
    draw_scale_bar(canvas, left + 20.0, plan.top + kHeight - 40.0, bar_m, pixels_per_m, 1.0);
    const Legend legend{{kSeen, "seen by a level laser", {}},
                        {kBlind, "blind, within 1 m of the body", {}},
                        {kWheel, "wheels", {}},
                        {kStop, fmt::format("stops within {:.2f} m", stop_m), {}}};
    return draw_legend(canvas, legend, left, plan.top + kHeight + 16.0, kWidth);
  });
}

}  // namespace adit

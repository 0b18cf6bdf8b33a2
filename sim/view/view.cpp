// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "sim/view/view.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <functional>
#include <numbers>
#include <string>
#include <vector>

#include "common/picture/canvas.hpp"
#include "common/picture/map_keys.hpp"
#include "common/picture/palette.hpp"
#include "common/picture/scale_bar.hpp"
#include "sim/view/perspective_view.hpp"
#include "sim/view/plan_view.hpp"
#include "sim/view/section_line.hpp"
#include "sim/view/section_view.hpp"

namespace adit {
namespace {

constexpr int kWidth = 1800;
constexpr int kEdge = 20;
constexpr int kContent = kWidth - 2 * kEdge;
constexpr int kPlanHeightMax = 900;
constexpr int kPerspectiveHeight = 800;
constexpr int kTitle = 64;              // height of the title of the sheet
constexpr int kHead = 44;               // of that of a panel
constexpr int kFoot = 52;               // of what stands below a panel
constexpr int kGap = 10;                // between the windows of a panel
constexpr int kTicks = 22;              // below a window of the section
constexpr double kScaleBarMax = 220.0;  // [pixels]
constexpr Colour kGas = rgb(0xd08a00);

/// Where one window of a panel goes on the sheet.
template <class Window>
struct Placed {
  Window window;
  int x;
  int y;

  [[nodiscard]] Eigen::Vector2d on_sheet(const Eigen::Vector2d& uv) const {
    return uv + Eigen::Vector2d(x, y);
  }
};

/// Windows below each other from `y` on, each in the middle of the sheet, which `y` is moved past.
template <class Window>
std::vector<Placed<Window>> stack(const std::vector<Window>& windows, int gap, int& y) {
  std::vector<Placed<Window>> placed;
  for (const Window& window : windows) {
    placed.push_back({window, (kWidth - window.width()) / 2, y});
    y += window.height() + gap;
  }
  return placed;
}

void draw_head(const Canvas& canvas, const std::string& title, int y) {
  canvas.colour(kInk);
  canvas.text(title, kEdge, y + 30.0, 20.0, true, Align::kLeft);
}

void draw_note(const Canvas& canvas, const std::string& note, int y) {
  canvas.colour(kInk);
  canvas.text(note, kWidth - kEdge, y + 30.0, 15.0, false, Align::kRight);
}

void draw_scale(const Canvas& canvas, double pixels_per_metre, int y) {
  draw_scale_bar(canvas, kEdge, y + 16.0, scale_bar_m(kScaleBarMax / pixels_per_metre),
                 pixels_per_metre, 1.0);
}

/// An arrow from where something is to where it looks.
void draw_arrow(const Canvas& canvas, const Eigen::Vector2d& p, double heading_rad, double length,
                const Colour& colour) {
  const Eigen::Vector2d ahead(std::cos(heading_rad), -std::sin(heading_rad));  // v points down
  const Eigen::Vector2d aside(-ahead.y(), ahead.x());
  const Eigen::Vector2d tip = p + length * ahead;
  const Eigen::Vector2d left = p - 0.35 * length * aside;
  const Eigen::Vector2d right = p + 0.35 * length * aside;
  cairo_t* cairo = canvas.cairo();
  cairo_move_to(cairo, tip.x(), tip.y());
  cairo_line_to(cairo, left.x(), left.y());
  cairo_line_to(cairo, right.x(), right.y());
  cairo_close_path(cairo);
  canvas.colour(colour);
  cairo_fill_preserve(cairo);
  canvas.colour(kOpen);
  cairo_set_line_width(cairo, 1.5);
  cairo_stroke(cairo);
}

void draw_gas(const Canvas& canvas, const GasPocket& gas, const Eigen::Vector2d& p,
              double pixels_per_metre) {
  canvas.colour(kGas);
  cairo_set_line_width(canvas.cairo(), 2.0);
  cairo_new_path(canvas.cairo());
  cairo_arc(canvas.cairo(), p.x(), p.y(), gas.radius_m * pixels_per_metre, 0.0,
            2.0 * std::numbers::pi);
  cairo_stroke(canvas.cairo());
  canvas.text("gas", p.x(), p.y() + 5.0, 14.0, true, Align::kCentre);
}

/// What is marked in the plan, where the window shows it.
void mark(const Canvas& canvas, const Placed<PlanWindow>& placed, const World& world,
          const Pose2& T_world_camera) {
  const PlanWindow& window = placed.window;
  cairo_save(canvas.cairo());
  cairo_rectangle(canvas.cairo(), placed.x, placed.y, window.width(), window.height());
  cairo_clip(canvas.cairo());
  const auto at = [&](const Eigen::Vector2d& p) { return placed.on_sheet(window.pixel(p)); };
  for (const SoftGround& mud : world.soft_ground) {
    canvas.colour(rgb(0x4a3218, 0.55));
    const Eigen::Vector2d p = at(mud.p_world);
    canvas.disc(p.x(), p.y(), mud.radius_m * window.pixels_per_metre);
  }
  for (const GasPocket& gas : world.gas) {
    draw_gas(canvas, gas, at(gas.p_world), window.pixels_per_metre);
  }
  draw_arrow(canvas, at(T_world_camera.translation()), T_world_camera.theta, 16.0, kEnd);
  draw_start(canvas, at(world.T_world_start.translation()), 0.7);
  cairo_restore(canvas.cairo());
}

/// Distances along the line, below a window of the section.
void draw_ticks(const Canvas& canvas, const Placed<SectionWindow>& placed) {
  const SectionWindow& window = placed.window;
  const double every = scale_bar_m(kScaleBarMax / window.pixels_per_metre);
  canvas.colour(kInk);
  const double y = placed.y + window.height();
  for (double s = every * std::ceil(window.from_m / every); s <= window.to_m; s += every) {
    const double x = placed.x + window.pixel(s, 0.0).x();
    canvas.fill_rectangle(x - 0.5, y, 1.0, 4.0);
    char label[32];
    std::snprintf(label, sizeof(label), "%g m", s);
    canvas.text(label, std::clamp(x, kEdge + 20.0, kWidth - kEdge - 20.0), y + 17.0, 13.0, false,
                Align::kCentre);
  }
}

std::string facts(const World& world) {
  char text[160];
  std::snprintf(text, sizeof(text), "%.0f m of drift, %zu triangles", world.truth.drifts.length_m(),
                world.mesh.triangles.size());
  return text;
}

std::string section_title(const DriftLine& line, double exaggeration) {
  char text[200];
  std::snprintf(text, sizeof(text), "Section %s, %s", line.name.c_str(),
                exaggeration == 1.0 ? "heights to scale" : "heights exaggerated");
  std::string title = text;
  if (exaggeration != 1.0) {
    std::snprintf(text, sizeof(text), " %g times", exaggeration);
    title += text;
  }
  return title;
}

std::string camera_title(const Camera& camera, const Pose2& at, double eye_m) {
  char text[200];
  std::snprintf(text, sizeof(text),
                "From x = %.1f m, y = %.1f m, %.1f m above the floor (z = %.1f m)", at.x, at.y,
                eye_m, camera.eye().z());
  return text;
}

Pose2 in_plan(const Camera& camera) {
  const Eigen::Vector3d ahead = camera.T_world_camera().linear().col(0);
  return {camera.eye().x(), camera.eye().y(), std::atan2(ahead.y(), ahead.x())};
}

}  // namespace

void write_view(const Site& site, const std::filesystem::path& png, const ViewOptions& options) {
  const World& world = site.world();
  const PlanView plan(world);
  const DriftLine line = section_line(site, options);
  const SectionView section(site, line);
  const Camera camera = camera_of(site, options, kContent, kPerspectiveHeight);

  int y = kTitle;
  const int plan_head = y;
  const auto plans = stack(plan.windows(kContent, kPlanHeightMax, kGap), kGap, y += kHead);
  const int section_head = y += kFoot;
  const auto sections = stack(section.windows(kContent), kTicks, y += kHead);
  const int camera_head = y += kFoot;
  y += kHead;

  const Canvas canvas(kWidth, y + kPerspectiveHeight + kEdge);
  canvas.colour(kPaper);
  canvas.fill_rectangle(0, 0, kWidth, y + kPerspectiveHeight + kEdge);
  canvas.colour(kInk);
  canvas.text(world.name, kEdge, 44.0, 28.0, true, Align::kLeft);
  canvas.text(facts(world), kWidth - kEdge, 44.0, 16.0, false, Align::kRight);

  draw_head(canvas, "Plan, the roof lifted off", plan_head);
  draw_note(canvas, "green dot: start; red arrow: camera", plan_head);
  for (const auto& placed : plans) {
    canvas.image(plan.draw(placed.window), placed.x, placed.y);
    mark(canvas, placed, world, in_plan(camera));
  }
  draw_scale(canvas, plans.front().window.pixels_per_metre, section_head - kFoot);

  draw_head(canvas, section_title(line, sections.front().window.exaggeration), section_head);
  draw_note(canvas, "seen from the right of the line", section_head);
  for (const auto& placed : sections) {
    canvas.image(section.draw(placed.window), placed.x, placed.y);
    draw_ticks(canvas, placed);
  }
  draw_scale(canvas, sections.front().window.pixels_per_metre, camera_head - kFoot);

  draw_head(canvas, camera_title(camera, in_plan(camera), options.eye_m), camera_head);
  canvas.image(perspective_view(site.scene(), camera), kEdge, y);
  canvas.write_png(png);
}

}  // namespace adit

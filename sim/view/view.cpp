// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "sim/view/view.hpp"

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "common/picture/canvas.hpp"
#include "common/picture/legend.hpp"
#include "common/picture/palette.hpp"
#include "sim/view/perspective_view.hpp"
#include "sim/view/plan_view.hpp"
#include "sim/view/section_view.hpp"

namespace adit {
namespace {

// All in pixels.
constexpr int kWidthMin = 600;
constexpr int kEdge = 20;
constexpr int kTitle = 64;  // height of the title of the sheet
constexpr int kHead = 44;   // of that of a panel
constexpr int kFoot = 52;   // of the scale below a panel
constexpr int kGap = 10;    // between the windows of the plan
constexpr int kTicks = 22;  // below a window of the section
constexpr double kScaleBarMax = 220.0;

/// Position of one window of a panel on the sheet.
template <class Window>
struct Placed {
  Window window;
  Eigen::Vector2i corner;
};

/// Places windows below each other from `y`, centred on the sheet; advances `y`.
template <class Window>
std::vector<Placed<Window>> stack(const std::vector<Window>& windows, int width, int gap, int& y) {
  std::vector<Placed<Window>> placed;
  for (const Window& window : windows) {
    placed.push_back({window, {(width - window.width()) / 2, y}});
    y += window.height() + gap;
  }
  return placed;
}

void draw_head(const Canvas& canvas, int width, int y, const std::string& title,
               const std::string& note) {
  canvas.colour(kInk);
  canvas.text(title, kEdge, y + 30.0, 20.0, true, Align::kLeft);
  canvas.text(note, width - kEdge, y + 30.0, 15.0, false, Align::kRight);
}

void draw_scale(const Canvas& canvas, double pixels_per_metre, int y) {
  draw_scale_bar(canvas, kEdge, y + 16.0, scale_bar_m(kScaleBarMax / pixels_per_metre),
                 pixels_per_metre, 1.0);
}

/// Scale of distances along the line, below a window of the section.
void draw_ticks(const Canvas& canvas, const Placed<SectionWindow>& placed) {
  const SectionWindow& window = placed.window;
  const double every = scale_bar_m(kScaleBarMax / window.pixels_per_metre);
  const double y = placed.corner.y() + window.height();
  canvas.colour(kInk);
  const double first = every * std::ceil(window.from_m / every);
  const int ticks = static_cast<int>((window.to_m - first) / every);
  for (int k = 0; k <= ticks; ++k) {
    const double s = first + k * every;
    const double x = placed.corner.x() + window.pixel(s, 0.0).x();
    canvas.fill_rectangle(x - 0.5, y, 1.0, 4.0);
    const Align align = k == 0 ? Align::kLeft : k == ticks ? Align::kRight : Align::kCentre;
    canvas.text(fmt::format("{:g} m", s), x, y + 17.0, 13.0, false, align);
  }
}

std::string section_title(const TunnelLine& line, double exaggeration) {
  const std::string heights = exaggeration == 1.0
                                  ? "heights to scale"
                                  : fmt::format("heights exaggerated {:g} times", exaggeration);
  return fmt::format("Section {}, {}", line.name, heights);
}

Pose2 in_plan(const Camera& camera) {
  const Eigen::Vector3d ahead = camera.T_world_camera().linear().col(0);
  return {camera.eye().x(), camera.eye().y(), std::atan2(ahead.y(), ahead.x())};
}

std::string camera_title(const Pose2& at, double eye_m) {
  return fmt::format("From x = {:.1f} m, y = {:.1f} m, {:.1f} m above the floor", at.x, at.y,
                     eye_m);
}

}  // namespace

void write_view(const Site& site, const std::filesystem::path& png, const ViewOptions& options) {
  const World& world = site.world();
  const int width = std::max(options.width_px, kWidthMin);
  const int content = width - 2 * kEdge;
  const Camera camera = camera_of(site, options, content, content * 9 / 20);
  const PlanView plan(world);
  const TunnelLine line = section_line(site, options);
  const SectionView section(site, line);

  int y = kTitle + kHead;
  const auto plans = stack(plan.windows(content, content / 2, kGap), width, kGap, y);
  const int plan_end = y;
  y += kFoot + kHead;
  const auto sections = stack(section.windows(content), width, kTicks, y);
  const int section_end = y;
  y += kFoot + kHead;

  const Canvas canvas(width, y + camera.height() + kEdge);
  canvas.colour(kPaper);
  canvas.fill_rectangle(0, 0, width, y + camera.height() + kEdge);
  canvas.colour(kInk);
  canvas.text(world.name, kEdge, 44.0, 28.0, true, Align::kLeft);
  canvas.text(fmt::format("{:.0f} m of tunnels, {} triangles", world.truth.tunnels.length_m(),
                          world.mesh.triangles.size()),
              width - kEdge, 44.0, 16.0, false, Align::kRight);

  draw_head(canvas, width, kTitle, "Plan without the roof", "green: start; red: camera");
  for (const auto& [window, corner] : plans) {
    canvas.image(plan.draw(window), corner.x(), corner.y());
    draw_plan_overlay(canvas, window, corner, world, in_plan(camera));
  }
  draw_scale(canvas, plans.front().window.pixels_per_metre, plan_end);

  draw_head(canvas, width, plan_end + kFoot,
            section_title(line, sections.front().window.exaggeration), "from its right side");
  for (const auto& placed : sections) {
    canvas.image(section.draw(placed.window), placed.corner.x(), placed.corner.y());
    draw_ticks(canvas, placed);
  }
  draw_scale(canvas, sections.front().window.pixels_per_metre, section_end);

  draw_head(canvas, width, section_end + kFoot, camera_title(in_plan(camera), options.eye_m), "");
  canvas.image(perspective_view(site.scene(), camera), kEdge, y);
  canvas.write_png(png);
}

}  // namespace adit

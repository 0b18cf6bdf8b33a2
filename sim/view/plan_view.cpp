// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "sim/view/plan_view.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <numbers>

#include "common/picture/map_layout.hpp"
#include "common/picture/palette.hpp"
#include "sim/mesh/triangle_mesh.hpp"
#include "sim/view/render.hpp"
#include "sim/view/shading.hpp"

namespace adit {
namespace {

constexpr double kMargin = 2.0;  // of rock around the mine [m]
constexpr int kWindowsMax = 4;
constexpr double kPixelsPerMetreMax = 40.0;
constexpr float kReliefFactor = 4.0F;    // by which slopes of the floor are drawn steeper
constexpr float kOcclusionReach = 1.0F;  // [m]
constexpr double kCut = 1.5;             // above the floor: what is level there counts as roof [m]
const Eigen::Vector3f kToLight = Eigen::Vector3f(-1.0F, 1.0F, 1.6F).normalized();

/// The roof of an imported mesh has to be guessed.
bool is_level_and_high(const World& world, const TriangleMesh::Triangle& triangle) {
  const auto& vertices = world.mesh.vertices;
  const Eigen::Vector3f& a = vertices[triangle[0]];
  const Eigen::Vector3f& b = vertices[triangle[1]];
  const Eigen::Vector3f& c = vertices[triangle[2]];
  const Eigen::Vector3d middle = ((a + b + c) / 3.0F).cast<double>();
  const auto floor_m = world.truth.floor_at(middle.head<2>());
  return floor_m && middle.z() > *floor_m + kCut &&
         std::abs((b - a).cross(c - a).normalized().z()) > 0.5F;
}

TriangleMesh without_roof(const World& world) {
  const TriangleMesh& complete = world.mesh;
  TriangleMesh mesh{complete.vertices, {}, {}, complete.parts};
  for (std::uint32_t i = 0; i < complete.triangles.size(); ++i) {
    const PartKind kind = complete.part_of(i).kind;
    if (kind == PartKind::kRoof) continue;
    if (kind == PartKind::kOther && is_level_and_high(world, complete.triangles[i])) continue;
    mesh.triangles.push_back(complete.triangles[i]);
    mesh.triangle_parts.push_back(complete.triangle_parts[i]);
  }
  return mesh;
}

bool is_ground(PartKind kind) { return kind == PartKind::kFloor || kind == PartKind::kOther; }

Rgb lit(const Part& part, const ShadedPoint& point, float openness) {
  Eigen::Vector3f normal = point.normal;
  if (is_ground(part.kind)) {
    normal.head<2>() *= kReliefFactor;
    normal.normalize();
  }
  const float sun = 0.75F * std::max(0.0F, normal.dot(kToLight));
  return (0.25F + 0.75F * openness) * (0.55F + sun) * plain_colour(part);
}

}  // namespace

int PlanWindow::width() const {
  return static_cast<int>(std::lround((high.x() - low.x()) * pixels_per_metre));
}

int PlanWindow::height() const {
  return static_cast<int>(std::lround((high.y() - low.y()) * pixels_per_metre));
}

Eigen::Vector2d PlanWindow::pixel(const Eigen::Vector2d& p_world) const {
  return pixels_per_metre * Eigen::Vector2d(p_world.x() - low.x(), high.y() - p_world.y());
}

Eigen::Vector2d PlanWindow::p_world(const Eigen::Vector2d& uv) const {
  return {low.x() + uv.x() / pixels_per_metre, high.y() - uv.y() / pixels_per_metre};
}

PlanView::PlanView(const World& world) : world_(world), mesh_(without_roof(world)), scene_(mesh_) {
  const Eigen::AlignedBox3f box = mesh_bounds(mesh_);
  if (box.isEmpty()) return;
  low_ = box.min().cast<double>();
  high_ = box.max().cast<double>();
}

std::vector<PlanWindow> PlanView::windows(int width, int height_max, int gap) const {
  const Eigen::Vector2d low = low_.head<2>() - Eigen::Vector2d::Constant(kMargin);
  const Eigen::Vector2d high = high_.head<2>() + Eigen::Vector2d::Constant(kMargin);
  const Eigen::Vector2d size = high - low;
  int count = 1;
  double scale = 0.0;
  for (int n = 1; n <= kWindowsMax; ++n) {
    const double room = (height_max - (n - 1) * gap) / static_cast<double>(n);
    const double fits = std::min({n * width / size.x(), room / size.y(), kPixelsPerMetreMax});
    if (fits <= 1.2 * scale) continue;  // split only if it increases the scale
    count = n;
    scale = fits;
  }
  std::vector<PlanWindow> windows;
  for (int i = 0; i < count; ++i) {
    const double from = low.x() + i * size.x() / count;
    windows.push_back({{from, low.y()}, {from + size.x() / count, high.y()}, scale});
  }
  return windows;
}

RgbImage PlanView::draw(const PlanWindow& window) const {
  const double top = high_.z() + 1.0;
  const auto reach = static_cast<float>(top - low_.z() + 1.0);
  const auto paint = [&](std::span<const Eigen::Vector2d> samples, std::span<Rgb> light) {
    std::vector<Ray> rays;
    rays.reserve(samples.size());
    for (const Eigen::Vector2d& uv : samples) {
      const Eigen::Vector2d p = window.p_world(uv);
      rays.push_back({Eigen::Vector3d(p.x(), p.y(), top).cast<float>(), -Eigen::Vector3f::UnitZ()});
    }
    std::vector<RayHit> hits(rays.size());
    scene_.cast(rays, reach, hits);
    std::vector<ShadedPoint> points(rays.size(), {rays[0].origin, Eigen::Vector3f::UnitZ()});
    for (std::size_t i = 0; i < rays.size(); ++i) {
      if (std::isfinite(hits[i].distance_m)) points[i] = shaded_point(rays[i], hits[i]);
    }
    std::vector<float> openness(points.size());
    find_openness(scene_, points, kOcclusionReach, openness);
    for (std::size_t i = 0; i < rays.size(); ++i) {
      const bool rock = std::isinf(hits[i].distance_m) ||
                        !is_open(points[i].p_world, mesh_.part_of(hits[i].triangle).kind);
      light[i] =
          rock ? linear(kRock) : lit(mesh_.part_of(hits[i].triangle), points[i], openness[i]);
    }
  };
  return render(window.width(), window.height(), paint);
}

/// Water and props may extend into the rock.
bool PlanView::is_open(const Eigen::Vector3f& p_world, PartKind kind) const {
  if (is_ground(kind)) return true;
  const auto& floor_height = world_.truth.floor_height;
  return kind != PartKind::kWall &&
         (!floor_height || floor_height(p_world.head<2>().cast<double>()).has_value());
}

namespace {

constexpr Colour kGas = rgb(0xd08a00);
constexpr double kArrow = 16.0;  // length [pixels]

/// A triangle at a pose whose tip shows the heading.
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

void draw_plan_overlay(const Canvas& canvas, const PlanWindow& window,
                       const Eigen::Vector2i& corner, const World& world,
                       const Pose2& T_world_camera) {
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

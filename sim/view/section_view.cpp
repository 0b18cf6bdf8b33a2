// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "sim/view/section_view.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numbers>

#include <Eigen/Geometry>
#include <fmt/format.h>

#include "sim/view/render.hpp"
#include "sim/view/shading.hpp"

namespace adit {
namespace {

constexpr float kAheadMax = 100.0F;  // [m]
constexpr double kIntoRock = 0.5;    // extension of the line behind a wall [m]

TunnelLine line_of(const TunnelEdge& edge) {
  return {edge.tunnel, edge.points, edge.width_m, false};
}

const TunnelEdge& nearest_edge(const TunnelGraph& tunnels, const Eigen::Vector2d& p_world) {
  return *std::min_element(tunnels.edges.begin(), tunnels.edges.end(),
                           [&](const TunnelEdge& a, const TunnelEdge& b) {
                             return line_of(a).distance_m(p_world) < line_of(b).distance_m(p_world);
                           });
}

/// The consecutive edges of one tunnel as a polyline.
TunnelLine full_tunnel(const TunnelGraph& tunnels, const std::string& name) {
  TunnelLine line{fmt::format("along {}", name), {}, 0.0, false};
  for (const TunnelEdge& edge : tunnels.edges) {
    if (edge.tunnel != name) continue;
    const bool continues = !line.points.empty() && line.points.back() == edge.points.front();
    if (!line.points.empty() && !continues) continue;
    line.points.insert(line.points.end(), edge.points.begin() + (continues ? 1 : 0),
                       edge.points.end());
  }
  return line;
}

/// Extent of the line from a point to behind the next wall [m].
double room(const Site& site, const Pose2& from) {
  const double floor_m = site.world().truth.floor_at(from.translation()).value_or(0.0);
  const Eigen::Vector3d eye(from.x, from.y, floor_m + 1.0);
  const Eigen::Vector3d ahead(std::cos(from.theta), std::sin(from.theta), 0.0);
  const Ray ray{eye.cast<float>(), ahead.cast<float>()};
  return distance_to_rock(site.scene(), ray, kAheadMax) + kIntoRock;
}

TunnelLine straight_ahead(const Site& site) {
  const Pose2& start = site.world().T_world_start;
  const Pose2 behind{-room(site, start * Pose2{0.0, 0.0, std::numbers::pi}), 0.0, 0.0};
  const Pose2 ahead{room(site, start), 0.0, 0.0};
  return {"straight ahead",
          {(start * behind).translation(), (start * ahead).translation()},
          0.0,
          false};
}

}  // namespace

TunnelLine section_line(const Site& site, const ViewOptions& options) {
  if (options.section.size() >= 2) return {"along the given line", options.section, 0.0, false};
  const TunnelGraph& tunnels = site.world().truth.tunnels;
  if (tunnels.edges.empty()) return straight_ahead(site);
  const Eigen::Vector2d start = site.world().T_world_start.translation();
  return full_tunnel(tunnels, nearest_edge(tunnels, start).tunnel);
}

namespace {

constexpr int kWindowsMax = 4;
constexpr int kProbes = 200;  // probes of the opening along a window
constexpr double kPixelsPerMetreMin = 20.0;
constexpr double kPixelsPerMetreMax = 60.0;
constexpr double kClearancePixelsMin = 36.0;
constexpr double kMargin = 0.5;     // of rock above and below, without exaggeration [m]
constexpr double kProbe = 0.3;      // height of the probes above the floor [m]
constexpr float kReach = 10.0F;     // of the probes, up and down; beyond is open sky [m]
constexpr float kDepthMax = 60.0F;  // visible depth behind the cut [m]
constexpr float kDarkening = 8.0F;  // depth at which light falls to 1/e [m]
const Rgb kAir = linear(0xe4ded2);

Ray ray_behind(const TunnelLine::Station& at, double z) {
  const Eigen::Vector3d left(-std::sin(at.heading_rad), std::cos(at.heading_rad), 0.0);
  return {Eigen::Vector3d(at.p_world.x(), at.p_world.y(), z).cast<float>(), left.cast<float>()};
}

/// Colours behind the cut: props in their own colour, rock in a light one.
Rgb behind(const TriangleMesh& mesh, const Ray& ray, const RayHit& hit) {
  if (std::isinf(hit.distance_m)) return std::exp(-kDepthMax / kDarkening) * kAir;
  const Part& part = mesh.part_of(hit.triangle);
  const float facing = std::abs(hit.normal.dot(ray.direction));
  if (is_mine_surface(part.kind)) {
    return std::exp(-hit.distance_m / kDarkening) * (0.55F + 0.45F * facing) * kAir;
  }
  return (0.5F + 0.5F * facing) * colour_at(part, shaded_point(ray, hit).p_world);
}

/// 1, or the vertical exaggeration that makes an opening of this many pixels visible.
double exaggeration_for(double clearance_px) {
  for (const double factor : {1.0, 2.0, 5.0}) {
    if (factor * clearance_px >= kClearancePixelsMin) return factor;
  }
  return 10.0;
}

}  // namespace

int SectionWindow::width() const {
  return static_cast<int>(std::lround((to_m - from_m) * pixels_per_metre));
}

int SectionWindow::height() const {
  return static_cast<int>(std::lround((z_high_m - z_low_m) * pixels_per_metre * exaggeration));
}

Eigen::Vector2d SectionWindow::pixel(double s_m, double z_m) const {
  return {(s_m - from_m) * pixels_per_metre, (z_high_m - z_m) * pixels_per_metre * exaggeration};
}

std::pair<double, double> SectionWindow::place(const Eigen::Vector2d& uv) const {
  return {from_m + uv.x() / pixels_per_metre,
          z_high_m - uv.y() / (pixels_per_metre * exaggeration)};
}

std::vector<SectionWindow> SectionView::windows(int width) const {
  const double length = std::max(line_.length_m(), 1.0);
  const int count =
      std::clamp(static_cast<int>(std::ceil(length * kPixelsPerMetreMin / width)), 1, kWindowsMax);
  const double scale = std::min(count * width / length, kPixelsPerMetreMax);
  std::vector<SectionWindow> windows;
  double tallest = 0.0;
  double highest_clearance = 0.0;
  for (int i = 0; i < count; ++i) {
    SectionWindow window{i * length / count, (i + 1) * length / count, 0.0, 0.0, scale, 1.0};
    Eigen::AlignedBox1d heights;
    for (const auto& clearance : clearances(window, kProbes)) {
      if (!clearance) continue;
      heights.extend(Eigen::Matrix<double, 1, 1>(clearance->floor_m));
      heights.extend(Eigen::Matrix<double, 1, 1>(clearance->roof_m));
      highest_clearance = std::max(highest_clearance, clearance->roof_m - clearance->floor_m);
    }
    if (!heights.isEmpty()) {
      window.z_low_m = heights.min().x();
      window.z_high_m = heights.max().x();
    }
    tallest = std::max(tallest, window.z_high_m - window.z_low_m);
    windows.push_back(window);
  }
  for (SectionWindow& window : windows) {
    const double middle = (window.z_low_m + window.z_high_m) / 2.0;
    window.z_low_m = middle - tallest / 2.0 - kMargin;
    window.z_high_m = middle + tallest / 2.0 + kMargin;
    window.exaggeration = exaggeration_for(highest_clearance * scale);
  }
  return windows;
}

RgbImage SectionView::draw(const SectionWindow& window) const {
  const auto clearance_of_half_pixel = clearances(window, 2 * window.width());
  const auto paint = [&](std::span<const Eigen::Vector2d> samples, std::span<Rgb> light) {
    std::fill(light.begin(), light.end(), linear(kRock));
    std::vector<Ray> rays;
    std::vector<std::size_t> sample_of_ray;
    for (std::size_t i = 0; i < samples.size(); ++i) {
      const auto [s, z] = window.place(samples[i]);
      const auto& clearance =
          clearance_of_half_pixel[static_cast<std::size_t>(2.0 * samples[i].x())];
      if (!clearance || z <= clearance->floor_m || z >= clearance->roof_m) continue;
      rays.push_back(ray_behind(line_.at(s), z));
      sample_of_ray.push_back(i);
    }
    std::vector<RayHit> hits(rays.size());
    site_.scene().cast(rays, kDepthMax, hits);
    for (std::size_t k = 0; k < rays.size(); ++k) {
      light[sample_of_ray[k]] = behind(site_.scene().mesh(), rays[k], hits[k]);
    }
  };
  return render(window.width(), window.height(), paint);
}

std::vector<std::optional<SectionView::Clearance>> SectionView::clearances(
    const SectionWindow& window, int count) const {
  std::vector<std::optional<Clearance>> found;
  for (int i = 0; i < count; ++i) {
    found.push_back(clearance_at(std::lerp(window.from_m, window.to_m, (i + 0.5) / count)));
  }
  return found;
}

std::optional<SectionView::Clearance> SectionView::clearance_at(double s_m) const {
  const Eigen::Vector2d p = line_.at(s_m).p_world;
  const auto floor_m = site_.world().truth.floor_at(p);
  if (!floor_m) return std::nullopt;
  const Eigen::Vector3f probe = Eigen::Vector3d(p.x(), p.y(), *floor_m + kProbe).cast<float>();
  const auto reach = [&](const Eigen::Vector3f& direction) {
    return distance_to_rock(site_.scene(), {probe, direction}, kReach);
  };
  const double down = reach(-Eigen::Vector3f::UnitZ());
  const double up = reach(Eigen::Vector3f::UnitZ());
  // Pits and hollows are not in the ground truth. They are missed behind a prop that reaches the
  // floor.
  return Clearance{down < kReach ? *floor_m + kProbe - down : *floor_m, *floor_m + kProbe + up};
}

}  // namespace adit

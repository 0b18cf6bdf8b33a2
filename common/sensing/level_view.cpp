// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "common/sensing/level_view.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <utility>

#include <Eigen/Geometry>

#include "common/sensing/range_on_line.hpp"

namespace adit {
namespace {

constexpr double kTurn = 2.0 * std::numbers::pi;
constexpr double kLevelRad = 0.1 * std::numbers::pi / 180.0;
constexpr double kSpacingMaxRad = 4.0 * std::numbers::pi / 180.0;  // between rings of one beam
constexpr double kColumnGapBeams = 2.5;                            // between neighbouring columns
constexpr double kSurfaceSlope = 1.5;    // horizontal distance over height: a wall
constexpr double kColumnsDiffer = 0.03;  // of the range: an edge between two columns
constexpr double kNearLevelM = 0.05;     // of the end of a ring that counts alone
constexpr double kLeanMax = 0.5;         // of a wall: horizontal distance over height
constexpr double kBesideBeams = 4.0;     // between two points of a ring that show a normal
constexpr double kUnknown = std::numeric_limits<double>::quiet_NaN();

/// From 0 to a turn.
double wrapped(double rad) { return rad - kTurn * std::floor(rad / kTurn); }

}  // namespace

LevelView::LevelView(const Lasers& lasers)
    : step_rad_(kTurn / lasers.lidar.level_beams), range_max_m_(lasers.front.range_max_m) {
  const Eigen::AngleAxisd to_lidar(-lasers.lidar.pitch_rad, Eigen::Vector3d::UnitY());
  up_lidar_ = to_lidar * Eigen::Vector3d::UnitZ();
  for (int i = 0; i < lasers.lidar.level_beams; ++i) {
    const double bearing = (i - 0.5 * (lasers.lidar.level_beams - 1)) * step_rad_;
    const Eigen::Vector3d d = to_lidar * Eigen::Vector3d(std::cos(bearing), std::sin(bearing), 0.0);
    beams_.push_back(
        {std::atan2(d.y(), d.x()), std::asin(std::clamp(d.z(), -1.0, 1.0)), {}, 0, 0, 0});
  }
}

void LevelView::find_rings(const std::vector<LidarRing>& rings) {
  if (rings == rings_) return;
  rings_ = rings;
  for (Beam& beam : beams_) {
    beam.below.reset();
    for (std::size_t i = 0; i < rings.size(); ++i) {
      const double off = rings[i].elevation_rad - beam.elevation_rad;
      if (std::abs(off) <= kLevelRad) {
        beam.below = beam.above = beam.below_of_plane = beam.above_of_plane = i;
        if (i + 1 < rings.size()) {
          ++beam.above_of_plane;
        } else if (i > 0) {
          --beam.below_of_plane;
        }
        break;
      }
      if (off > 0.0) {
        const bool between = i > 0 && rings[i].elevation_rad - rings[i - 1].elevation_rad <=
                                          static_cast<float>(kSpacingMaxRad);
        if (between) beam.below = beam.below_of_plane = i - 1;
        beam.above = beam.above_of_plane = i;
        break;
      }
    }
  }
}

int LevelView::beams_without_ring(const std::vector<LidarRing>& rings) {
  find_rings(rings);
  return static_cast<int>(
      std::ranges::count_if(beams_, [](const Beam& beam) { return !beam.below; }));
}

void LevelView::sort_columns(const LidarRevolution& revolution) {
  columns_.clear();
  for (std::size_t i = 0; i < revolution.columns.size(); ++i) {
    columns_.emplace_back(wrapped(revolution.columns[i].azimuth_rad), i);
  }
  std::ranges::sort(columns_);
}

std::optional<LevelView::Place> LevelView::place_of(double azimuth_rad) const {
  if (columns_.empty()) return std::nullopt;
  const double azimuth = wrapped(azimuth_rad);
  const auto next = std::ranges::upper_bound(columns_, std::pair(azimuth, columns_.size()));
  const auto& after = next == columns_.end() ? columns_.front() : *next;
  const auto& before = next == columns_.begin() ? columns_.back() : *std::prev(next);
  const double gap = wrapped(after.first - before.first);
  if (gap > kColumnGapBeams * step_rad_) return std::nullopt;
  const double share = gap > 0.0 ? wrapped(azimuth - before.first) / gap : 0.0;
  return Place{before.second, after.second, share};
}

/// Between two columns if both hit one surface, otherwise that of the nearer column.
double LevelView::ring_range_m(const LidarRevolution& revolution, std::size_t ring,
                               double azimuth_rad) const {
  const auto place = place_of(azimuth_rad - revolution.rings[ring].azimuth_offset_rad);
  if (!place) return kUnknown;
  const double before = revolution.range_m(place->before, ring);
  const double after = revolution.range_m(place->after, ring);
  if (std::abs(before - after) <= kColumnsDiffer * before) {
    return 1.0 / std::lerp(1.0 / before, 1.0 / after, place->share);
  }
  return place->share < 0.5 ? before : after;
}

/// Of the surface through the ends of two rings and of one of them beside the beam.
bool LevelView::is_steep(const LidarRevolution& revolution, const Beam& beam, double r1,
                         double r2) const {
  const auto end = [&](std::size_t ring, double azimuth_rad, double range_m) -> Eigen::Vector3d {
    const double elevation = revolution.rings[ring].elevation_rad;
    return range_m * Eigen::Vector3d(std::cos(elevation) * std::cos(azimuth_rad),
                                     std::cos(elevation) * std::sin(azimuth_rad),
                                     std::sin(elevation));
  };
  const Eigen::Vector3d below = end(beam.below_of_plane, beam.azimuth_rad, r1);
  const Eigen::Vector3d above = end(beam.above_of_plane, beam.azimuth_rad, r2);
  for (const double side : {1.0, -1.0}) {
    const double azimuth = beam.azimuth_rad + side * kBesideBeams * step_rad_;
    const double r3 = ring_range_m(revolution, beam.below_of_plane, azimuth);
    if (!std::isfinite(r3)) continue;
    const Eigen::Vector3d across =
        (above - below).cross(end(beam.below_of_plane, azimuth, r3) - below);
    const Eigen::Vector3d normal = up_lidar_ * up_lidar_.dot(across);
    if (normal.norm() <= kLeanMax * (across - normal).norm()) return true;
  }
  return false;
}

double LevelView::range_m(const LidarRevolution& revolution, const Beam& beam) const {
  if (!beam.below) return kUnknown;
  const double r1 = ring_range_m(revolution, beam.below_of_plane, beam.azimuth_rad);
  const double r2 = ring_range_m(revolution, beam.above_of_plane, beam.azimuth_rad);
  const bool is_plane = std::isfinite(r1) && std::isfinite(r2);
  if (*beam.below == beam.above) {  // one of them is level
    const double range_m = *beam.below == beam.below_of_plane ? r1 : r2;
    if (!(range_m > kObstacleReachM) || std::isinf(range_m)) return range_m;
    return is_plane && is_steep(revolution, beam, r1, r2) ? range_m : kUnknown;
  }
  const double below_rad = beam.elevation_rad - revolution.rings[*beam.below].elevation_rad;
  const double above_rad = revolution.rings[beam.above].elevation_rad - beam.elevation_rad;
  const double drop_m = r1 * std::sin(below_rad);  // infinite or NaN as the range
  const double rise_m = r2 * std::sin(above_rad);
  if (is_plane) {
    const double apart_m = std::abs(r2 * std::cos(above_rad) - r1 * std::cos(below_rad));
    const double range_m = range_on_line_m(r1, below_rad, r2, above_rad);
    if (apart_m <= kSurfaceSlope * (drop_m + rise_m) &&
        (range_m <= kObstacleReachM || is_steep(revolution, beam, r1, r2)))
      return range_m;
  }
  if (std::isinf(r1) && std::isinf(r2)) return r1;
  const bool below = drop_m <= kNearLevelM && r1 <= kObstacleReachM;  // false for NaN
  const bool above = rise_m <= kNearLevelM && r2 <= kObstacleReachM;
  if (below && above) return std::min(r1, r2);
  if (below) return r1;
  return above ? r2 : kUnknown;
}

LaserScan LevelView::scan(const LidarRevolution& revolution) {
  find_rings(revolution.rings);
  sort_columns(revolution);
  LaserScan scan{
      revolution.utime, {}, -0.5 * step_rad_ * static_cast<double>(beams_.size() - 1), step_rad_};
  scan.ranges_m.reserve(beams_.size());
  for (const Beam& beam : beams_) {
    const double range = range_m(revolution, beam);
    scan.ranges_m.push_back(static_cast<float>(std::isinf(range) ? range_max_m_ + 1.0 : range));
  }
  return scan;
}

std::vector<bool> LevelView::readings_used(const LidarRevolution& revolution) {
  find_rings(revolution.rings);
  sort_columns(revolution);
  std::vector<bool> used(revolution.columns.size() * revolution.rings.size());
  const auto use = [&](std::size_t ring, double azimuth_rad) {
    const auto place = place_of(azimuth_rad - revolution.rings[ring].azimuth_offset_rad);
    if (!place) return;
    used[place->before * revolution.rings.size() + ring] = true;
    used[place->after * revolution.rings.size() + ring] = true;
  };
  for (const Beam& beam : beams_) {
    if (!beam.below) continue;
    use(beam.below_of_plane, beam.azimuth_rad);
    use(beam.above_of_plane, beam.azimuth_rad);
    for (const double side : {1.0, -1.0})
      use(beam.below_of_plane, beam.azimuth_rad + side * kBesideBeams * step_rad_);
  }
  return used;
}

}  // namespace adit

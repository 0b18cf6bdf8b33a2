// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "procs/planning/c_space/unobserved_ground.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <functional>
#include <limits>
#include <optional>
#include <vector>

#include "procs/planning/c_space/footprint.hpp"

namespace adit {
namespace {

constexpr double kStripM = 0.5;             // length of the strip of ground beyond the blind zone
constexpr double kObservedShareMin = 0.25;  // of the cells of a strip
constexpr double kFarStripM = 1.0;          // length of the strip after it, for the slope

/// Mean height of the observed ground between two distances ahead of the origin of the body
/// (behind it where they are negative), within `half_width_m` of its x axis; nothing where less
/// than kObservedShareMin of the cells is observed.
std::optional<double> height_between(const TerrainMap& terrain, const Pose2& T_body_level,
                                     double near_m, double far_m, double half_width_m) {
  double sum = 0.0;
  int observed = 0;
  int cells = 0;
  for (int row = 0; row < terrain.cells.rows(); ++row) {
    for (int column = 0; column < terrain.cells.columns(); ++column) {
      const Eigen::Vector2d p_body = T_body_level * terrain.centre(column, row);
      const double ahead = p_body.x() * (near_m < 0.0 ? -1.0 : 1.0);
      if (ahead < std::abs(near_m) || ahead > std::abs(far_m)) continue;
      if (std::abs(p_body.y()) > half_width_m) continue;
      ++cells;
      const TerrainCell& cell = terrain.cells.at({column, row});
      if (cell.ground != Ground::kObserved || !std::isfinite(cell.low_m)) continue;
      ++observed;
      sum += cell.low_m;
    }
  }
  if (cells == 0 || observed < kObservedShareMin * cells) return std::nullopt;
  return sum / observed;
}

/// Whether the ground beyond the blind zone ahead (`side` 1) or behind (−1) continues the ground
/// under the robot, which may stand on a slope or on a change of it. Its height differs by less
/// than a step from that under the robot, as it is or extrapolated by its own slope to the end of
/// the robot or to its middle; or from what follows from the ground under that end of the robot,
/// with the grade there, the grade beyond, or one between.
bool continues_level(const TerrainMap& terrain, const Pose2& T_body_level, const Vehicle& vehicle,
                     const GroundLimits& limits, double side) {
  const double end_m = vehicle.length_m / 2.0;
  const double from_m = end_m + limits.blind_ahead_m;
  const double half_m = vehicle.width_m / 2.0 + limits.blind_margin_m;
  const double step_m = vehicle.step_max_m - limits.step_margin_m;
  const auto near = height_between(terrain, T_body_level, side * (from_m - kStripM / 2.0),
                                   side * (from_m + kStripM / 2.0), half_m);
  if (!near) return false;
  const auto far = height_between(terrain, T_body_level, side * (from_m + kStripM / 2.0),
                                  side * (from_m + kStripM / 2.0 + kFarStripM), half_m);
  const double grade = far ? (*far - *near) / ((kStripM + kFarStripM) / 2.0) : 0.0;
  const double at_end = *near - grade * limits.blind_ahead_m;
  const double at_middle = *near - grade * from_m;
  if (std::min({std::abs(*near), std::abs(at_end), std::abs(at_middle)}) < step_m) return true;
  const double under_m = end_m - kStripM / 2.0;
  const auto under = height_between(terrain, T_body_level, side * (end_m - kStripM), side * end_m,
                                    vehicle.width_m / 2.0);
  if (!under) return false;
  const auto [low, high] = std::minmax({grade, *under / under_m});
  const double distance_m = from_m - under_m;
  return *near > *under + low * distance_m - step_m && *near < *under + high * distance_m + step_m;
}

}  // namespace

BlindZone::BlindZone(const TerrainMap& terrain, const Pose2& T_level_body, const Vehicle& vehicle,
                     const GroundLimits& limits)
    : T_body_level_(T_level_body.inverse()) {
  const Eigen::Vector2d half = Eigen::Vector2d(vehicle.length_m, vehicle.width_m) / 2.0;
  parts_.push_back(ConvexPolygon::rectangle(Eigen::Vector2d::Zero(),
                                            half + Eigen::Vector2d(0.0, limits.blind_beside_m)));
  for (const double side : {-1.0, 1.0}) {
    if (!continues_level(terrain, T_body_level_, vehicle, limits, side)) continue;
    const double half_m = limits.blind_ahead_m / 2.0;
    parts_.push_back(ConvexPolygon::rectangle({side * (half.x() + half_m), 0.0},
                                              {half_m, half.y() + limits.blind_margin_m}));
  }
}

bool BlindZone::contains(const Eigen::Vector2d& p_level) const {
  return any_contains(parts_, T_body_level_ * p_level);
}

namespace {

constexpr std::ptrdiff_t kDropCells = 10;  // that show a drop: fewer may be stray beams
constexpr std::size_t kRimRank = 3;        // of the rim: fewer stray cells have no effect

/// A connected region of cells that beams passed over.
struct Depression {
  std::vector<std::size_t> cells;
  std::vector<std::size_t> rim;  ///< observed ground beside it, without obstacles
};

/// Whether no passable ground can lie in a cell: the beam over it is lower than a slope of
/// `grade_max` and a step down from the ground at the rim, wherever along the rim it begins.
bool is_drop(const TerrainMap& terrain, std::size_t cell, const Depression& depression,
             double step_max_m, double grade_max) {
  const Eigen::Vector2i at = terrain.cells.cell(cell);
  std::array<double, kRimRank> highest;  // of the least heights that passable ground may have here
  highest.fill(-std::numeric_limits<double>::infinity());
  for (const std::size_t i : depression.rim) {
    const double distance_m = terrain.cell_m * (terrain.cells.cell(i) - at).cast<double>().norm();
    const double least_m = static_cast<double>(terrain.cells[i].low_m) - grade_max * distance_m;
    if (least_m <= highest.back()) continue;
    highest.back() = least_m;
    std::ranges::sort(highest, std::greater{});
  }
  return static_cast<double>(terrain.cells[cell].low_m) < highest.back() - step_max_m;
}

class DepressionFinder {
 public:
  DepressionFinder(const TerrainMap& terrain, double step_max_m)
      : terrain_(terrain),
        step_max_m_(static_cast<float>(step_max_m)),
        visited_(terrain.cells.size(), false) {}

  /// The depression of a cell; empty where the cell belongs to none or was visited before.
  Depression of(int column, int row) {
    Depression depression;
    visit({column, row}, depression);
    for (std::size_t k = 0; k < depression.cells.size(); ++k) {
      const Eigen::Vector2i at = terrain_.cells.cell(depression.cells[k]);
      for (int dy = -1; dy <= 1; ++dy) {
        for (int dx = -1; dx <= 1; ++dx) visit(at + Eigen::Vector2i(dx, dy), depression);
      }
    }
    return depression;
  }

 private:
  void visit(const Eigen::Vector2i& at, Depression& depression) {
    if (!terrain_.cells.contains(at)) return;
    const std::size_t i = terrain_.cells.index(at);
    const TerrainCell& cell = terrain_.cells[i];
    const bool even = cell.ground == Ground::kObserved && !(cell.high_m - cell.low_m > step_max_m_);
    if (even && !depression.cells.empty()) depression.rim.push_back(i);
    if (cell.ground != Ground::kBelowRay || visited_[i]) return;
    visited_[i] = true;
    depression.cells.push_back(i);
  }

  const TerrainMap& terrain_;
  float step_max_m_;
  std::vector<bool> visited_;
};

}  // namespace

TerrainMap with_confirmed_drops(TerrainMap terrain, double step_max_m, double grade_max) {
  std::vector<std::size_t> unconfirmed;
  DepressionFinder depressions(terrain, step_max_m);
  for (int row = 0; row < terrain.cells.rows(); ++row) {
    for (int column = 0; column < terrain.cells.columns(); ++column) {
      const Depression depression = depressions.of(column, row);
      const auto drops = std::ranges::count_if(depression.cells, [&](std::size_t cell) {
        return is_drop(terrain, cell, depression, step_max_m, grade_max);
      });
      if (drops >= kDropCells) continue;
      unconfirmed.insert(unconfirmed.end(), depression.cells.begin(), depression.cells.end());
    }
  }
  for (const std::size_t i : unconfirmed) terrain.cells[i].ground = Ground::kNeverObserved;
  return terrain;
}

}  // namespace adit

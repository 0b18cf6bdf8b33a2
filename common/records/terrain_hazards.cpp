// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "common/records/terrain_hazards.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <string>

#include <fmt/format.h>

#include "common/geometry/order_statistics.hpp"
#include "common/grid/grid2.hpp"

namespace adit {
namespace {

constexpr double kWaterAreaMinM2 = 1.0;  // at a portal less has no return
constexpr double kRoofAreaMinM2 = 0.5;
constexpr double kDropAreaMinM2 = 0.2;   // a wheel fits in
constexpr double kDropReachM = 0.5;      // within which that ground is
constexpr double kAroundM = 2.0;         // within which the height of the ground is estimated
constexpr double kGroundQuantile = 0.3;  // of the heights there
constexpr double kAtRobotM = 2.5;        // its surroundings, on whose ground it stands
constexpr double kBridgedM = 0.3;        // of unseen ground

const std::array<Eigen::Vector2i, 4> kNeighbours{Eigen::Vector2i(1, 0), Eigen::Vector2i(-1, 0),
                                                 Eigen::Vector2i(0, 1), Eigen::Vector2i(0, -1)};

/// Cells of a terrain map that touch each other.
struct Region {
  CellBox box;
  std::vector<Eigen::Vector2i> cells;
};

/// Calls `use` for each cell of the map that is at most `reach` cells away along both axes.
template <class Use>
void for_cells_around(const TerrainMap& terrain, const Eigen::Vector2i& middle, int reach,
                      Use use) {
  for (int x = -reach; x <= reach; ++x) {
    for (int y = -reach; y <= reach; ++y) {
      const Eigen::Vector2i cell = middle + Eigen::Vector2i(x, y);
      if (terrain.cells.contains(cell)) use(cell);
    }
  }
}

/// Regions of the cells for which `is_part` holds, by flood fill.
template <class IsPart>
std::vector<Region> regions_of(const TerrainMap& terrain, IsPart is_part) {
  Grid2<std::uint8_t> seen(terrain.cells.box());
  std::vector<Region> regions;
  for (std::size_t i = 0; i < terrain.cells.size(); ++i) {
    const Eigen::Vector2i first = terrain.cells.cell(i);
    if (seen[i] != 0 || !is_part(first)) continue;
    Region region;
    seen[i] = 1;
    region.cells.push_back(first);
    for (std::size_t at = 0; at < region.cells.size(); ++at) {
      const Eigen::Vector2i cell = region.cells[at];
      region.box = united(region.box, cell);
      for (const Eigen::Vector2i& step : kNeighbours) {
        const Eigen::Vector2i next = cell + step;
        if (!terrain.cells.contains(next) || seen.at(next) != 0 || !is_part(next)) continue;
        seen.at(next) = 1;
        region.cells.push_back(next);
      }
    }
    regions.push_back(std::move(region));
  }
  return regions;
}

bool is_drivable(const TerrainCell& cell, const Vehicle& vehicle) {
  return cell.ground == Ground::kObserved &&
         cell.coefficient_m < static_cast<float>(vehicle.step_max_m);
}

/// Cells of drivable ground that the robot can reach from where it stood, the origin of level: 1,
/// others 0. Gaps of unseen ground that are no longer than kBridgedM do not end it.
Grid2<std::uint8_t> reachable_ground(const TerrainMap& terrain, const Vehicle& vehicle) {
  Grid2<std::uint8_t> reachable(terrain.cells.box());
  std::vector<Eigen::Vector2i> open;
  const auto reach_from = [&](const Eigen::Vector2i& cell) {
    reachable.at(cell) = 1;
    open.push_back(cell);
  };
  for (std::size_t i = 0; i < terrain.cells.size(); ++i) {
    const Eigen::Vector2i cell = terrain.cells.cell(i);
    const bool at_robot = terrain.centre(cell.x(), cell.y()).norm() < kAtRobotM &&
                          std::abs(terrain.cells[i].low_m) < vehicle.step_max_m;
    if (at_robot && is_drivable(terrain.cells[i], vehicle)) reach_from(cell);
  }
  const int bridged = static_cast<int>(std::lround(kBridgedM / terrain.cell_m));
  while (!open.empty()) {
    const Eigen::Vector2i from = open.back();
    open.pop_back();
    for_cells_around(terrain, from, bridged, [&](const Eigen::Vector2i& to) {
      if (reachable.at(to) != 0 || !is_drivable(terrain.cells.at(to), vehicle)) return;
      const float rise_m = terrain.cells.at(to).low_m - terrain.cells.at(from).low_m;
      if (std::abs(rise_m) <= static_cast<float>(vehicle.step_max_m)) reach_from(to);
    });
  }
  return reachable;
}

/// By how much a cell, or the beam that passed over it, lies lower than ground beside it that the
/// robot can reach [m]; 0 if that is not seen.
float depth_beside_ground_m(const TerrainMap& terrain, const Eigen::Vector2i& at,
                            const Grid2<std::uint8_t>& reachable, const Vehicle& vehicle) {
  const TerrainCell& cell = terrain.cells.at(at);
  const bool is_known = cell.ground == Ground::kObserved || cell.ground == Ground::kBelowRay;
  if (!is_known || reachable.at(at) != 0 || !std::isfinite(cell.low_m)) return 0.0F;
  const int reach = static_cast<int>(std::lround(kDropReachM / terrain.cell_m));
  float depth_m = 0.0F;
  for_cells_around(terrain, at, reach, [&](const Eigen::Vector2i& beside) {
    if (reachable.at(beside) != 0)
      depth_m = std::max(depth_m, terrain.cells.at(beside).low_m - cell.low_m);
  });
  if (depth_m <= static_cast<float>(vehicle.step_max_m)) return 0.0F;
  // Not the foot of a heap, on which most of the ground around does not lie.
  std::vector<double> heights_m;
  const int around = static_cast<int>(std::lround(kAroundM / terrain.cell_m));
  for_cells_around(terrain, at, around, [&](const Eigen::Vector2i& cell_around) {
    if (reachable.at(cell_around) != 0) heights_m.push_back(terrain.cells.at(cell_around).low_m);
  });
  const auto ground_m = static_cast<float>(quantile(std::move(heights_m), kGroundQuantile));
  return std::min(depth_m, ground_m - cell.low_m);
}

/// Lists the hazards of one terrain map.
class TerrainHazards {
 public:
  TerrainHazards(const TerrainMap& terrain, int number, double z_m)
      : terrain_(terrain), number_(number), z_m_(z_m) {}

  /// `value`: NaN for the area.
  void add(const char* kind, const Region& region, double value, const char* evidence) {
    const double area_m2 = area(region);
    const Eigen::Vector2d size_m = terrain_.cell_m * region.box.size().cast<double>();
    const Eigen::Vector2d p_level =
        terrain_.p_level_corner + terrain_.cell_m * region.box.from.cast<double>() + 0.5 * size_m;
    const bool has_value = std::isfinite(value);
    hazards_.push_back(
        {kind, has_value ? value : area_m2, has_value ? "m" : "m²",
         fmt::format("3D scan {}: {} over {:.1f} m²", number_, evidence, area_m2), terrain_.utime,
         LevelPose{terrain_.T_odom_level, z_m_} * LevelPose{{p_level.x(), p_level.y(), 0.0}, 0.0},
         size_m});
  }
  [[nodiscard]] double area(const Region& region) const {
    return static_cast<double>(region.cells.size()) * terrain_.cell_m * terrain_.cell_m;
  }
  [[nodiscard]] std::vector<Hazard> release() { return std::move(hazards_); }

 private:
  const TerrainMap& terrain_;
  int number_;
  double z_m_;
  std::vector<Hazard> hazards_;
};

void add_water(const TerrainMap& terrain, TerrainHazards& hazards) {
  const auto regions = regions_of(terrain, [&](const Eigen::Vector2i& cell) {
    return terrain.cells.at(cell).ground == Ground::kNoReturn;
  });
  for (const Region& region : regions) {
    if (hazards.area(region) < kWaterAreaMinM2) continue;
    hazards.add("water", region, std::numeric_limits<double>::quiet_NaN(),
                "no return from the ground, as from water,");
  }
}

void add_drops(const TerrainMap& terrain, const Vehicle& vehicle, TerrainHazards& hazards) {
  const Grid2<std::uint8_t> reachable = reachable_ground(terrain, vehicle);
  Grid2<float> depths_m(terrain.cells.box());
  for (std::size_t i = 0; i < depths_m.size(); ++i)
    depths_m[i] = depth_beside_ground_m(terrain, terrain.cells.cell(i), reachable, vehicle);
  const auto regions = regions_of(terrain, [&](const Eigen::Vector2i& cell) {
    return depths_m.at(cell) > static_cast<float>(vehicle.step_max_m);
  });
  for (const Region& region : regions) {
    if (hazards.area(region) < kDropAreaMinM2) continue;
    float depth_m = 0.0F;
    for (const Eigen::Vector2i& cell : region.cells) depth_m = std::max(depth_m, depths_m.at(cell));
    hazards.add("drop", region, depth_m, "ground that lies lower than that beside it");
  }
}

void add_low_roofs(const TerrainMap& terrain, const Vehicle& vehicle, TerrainHazards& hazards) {
  const auto regions = regions_of(terrain, [&](const Eigen::Vector2i& at) {
    const TerrainCell& cell = terrain.cells.at(at);
    return is_drivable(cell, vehicle) && is_above_belly(cell.clearance_m, vehicle) &&
           cell.clearance_m < static_cast<float>(vehicle.height_m);
  });
  for (const Region& region : regions) {
    if (hazards.area(region) < kRoofAreaMinM2) continue;
    float clearance_m = std::numeric_limits<float>::infinity();
    for (const Eigen::Vector2i& cell : region.cells)
      clearance_m = std::min(clearance_m, terrain.cells.at(cell).clearance_m);
    hazards.add("low roof", region, clearance_m, "roof lower than the vehicle");
  }
}

}  // namespace

std::vector<Hazard> hazards_of(const TerrainMap& terrain, int number, double z_m,
                               const Vehicle& vehicle) {
  TerrainHazards hazards(terrain, number, z_m);
  add_water(terrain, hazards);
  add_drops(terrain, vehicle, hazards);
  add_low_roofs(terrain, vehicle, hazards);
  return hazards.release();
}

}  // namespace adit

// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "common/records/hazard.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include <fmt/format.h>

#include "common/grid/grid2.hpp"

namespace adit {
namespace {

constexpr double kMethaneMaxShare = 0.01;          // 30 CFR 75.323
constexpr double kOxygenMinShare = 0.195;          // 30 CFR 75.321
constexpr double kCarbonMonoxideMaxShare = 50e-6;  // 30 CFR 75.322
constexpr double kSinkageMinM = 0.05;              // less is the tread of the wheels
constexpr double kNearM = 1.0;                     // gap between observations of one hazard
constexpr double kPlaceM = 3.0;                    // extent of what is measured at the robot
constexpr double kAreaMinM2 = 0.5;                 // of ground without returns and of low roof

/// What of a blocking cell is known, in words and with its unit.
struct CellHazard {
  const char* kind;
  const char* unit;
};

/// Nothing is said of cells that were not observed.
std::optional<CellHazard> hazard_of(BlockingCell::Reason reason) {
  using Reason = BlockingCell::Reason;
  switch (reason) {
    case Reason::kStep:
    case Reason::kBelly:
      return CellHazard{"step", "m"};
    case Reason::kRoof:
      return CellHazard{"low roof", "m"};
    case Reason::kWater:
      return CellHazard{"water", ""};
    case Reason::kSlope:
      return CellHazard{"slope", "m"};
    case Reason::kDrop:
      return CellHazard{"possible drop", ""};  // its ground was not seen
    case Reason::kUnknown:
      break;
  }
  return std::nullopt;
}

/// Whether so little room above the ground is left by a roof, rather than by an obstacle on the
/// ground or by a rib that overhangs: those begin below the belly, or below what passes for ground
/// (negative).
bool is_above_belly(double clearance_m, const Vehicle& vehicle) {
  return clearance_m >= vehicle.belly_clearance_m;
}

/// The worse of two values: the lower roof, otherwise the larger value.
double worse(const std::string& kind, double a, double b) {
  if (!std::isfinite(a) || !std::isfinite(b)) return std::isfinite(a) ? a : b;
  return kind == "low roof" || kind == "oxygen" ? std::min(a, b) : std::max(a, b);
}

/// Cells of a terrain map that touch each other.
struct Region {
  CellBox box;
  std::size_t cells = 0;
  double clearance_m = std::numeric_limits<double>::infinity();  ///< the smallest
};

/// Regions of the cells for which `is_part` holds, by flood fill.
template <class IsPart>
std::vector<Region> regions_of(const TerrainMap& terrain, IsPart is_part) {
  Grid2<std::uint8_t> seen(terrain.cells.box());
  std::vector<Region> regions;
  std::vector<Eigen::Vector2i> open;
  for (std::size_t i = 0; i < terrain.cells.size(); ++i) {
    if (seen[i] != 0 || !is_part(terrain.cells[i])) continue;
    Region region;
    seen[i] = 1;
    open.push_back(terrain.cells.cell(i));
    while (!open.empty()) {
      const Eigen::Vector2i cell = open.back();
      open.pop_back();
      region.box = united(region.box, cell);
      ++region.cells;
      const double clearance_m = terrain.cells.at(cell).clearance_m;
      if (std::isfinite(clearance_m))
        region.clearance_m = std::min(region.clearance_m, clearance_m);
      for (const auto& step : {Eigen::Vector2i(1, 0), Eigen::Vector2i(-1, 0), Eigen::Vector2i(0, 1),
                               Eigen::Vector2i(0, -1)}) {
        const Eigen::Vector2i next = cell + step;
        if (!terrain.cells.contains(next) || seen.at(next) != 0 || !is_part(terrain.cells.at(next)))
          continue;
        seen.at(next) = 1;
        open.push_back(next);
      }
    }
    regions.push_back(region);
  }
  return regions;
}

}  // namespace

std::vector<Hazard> hazards_of(const GasReading& reading, const LevelPose& T_odom_body) {
  std::vector<Hazard> hazards;
  const auto add = [&](const char* kind, double value, const char* unit) {
    hazards.push_back({kind, value, unit, "measured there", reading.utime, T_odom_body,
                       Eigen::Vector2d::Constant(kPlaceM)});
  };
  if (reading.methane_share >= kMethaneMaxShare) add("methane", 100.0 * reading.methane_share, "%");
  if (reading.oxygen_share < kOxygenMinShare) add("oxygen", 100.0 * reading.oxygen_share, "%");
  if (reading.carbon_monoxide_share >= kCarbonMonoxideMaxShare)
    add("carbon monoxide", 1e6 * reading.carbon_monoxide_share, "ppm");
  return hazards;
}

std::vector<Hazard> hazards_of(const SinkageReading& reading, const LevelPose& T_odom_body) {
  const double depth_m = *std::max_element(reading.depth_m.begin(), reading.depth_m.end());
  if (depth_m < kSinkageMinM) return {};
  return {{"mud", depth_m, "m", "the wheels sank in", reading.utime, T_odom_body,
           Eigen::Vector2d::Constant(kPlaceM)}};
}

std::vector<Hazard> hazards_of(const PlannedPath& path, double z_m, const Vehicle& vehicle) {
  std::vector<Hazard> hazards;
  for (const BlockingCell& cell : path.blocking) {
    const auto hazard = hazard_of(cell.reason);
    if (!hazard) continue;
    if (cell.reason == BlockingCell::Reason::kRoof && !is_above_belly(cell.height_m, vehicle))
      continue;
    hazards.push_back({hazard->kind,
                       cell.height_m,
                       hazard->unit,
                       fmt::format("blocks the path of plan {}", path.id),
                       path.utime,
                       {{cell.p_odom.x(), cell.p_odom.y(), 0.0}, z_m},
                       Eigen::Vector2d::Constant(0.1)});
  }
  return hazards;
}

std::vector<Hazard> hazards_of(const TerrainMap& terrain, int number, double z_m,
                               const Vehicle& vehicle) {
  const double cell_area_m2 = terrain.cell_m * terrain.cell_m;
  std::vector<Hazard> hazards;
  const auto add_regions = [&](const char* kind, const std::vector<Region>& regions, bool is_roof,
                               const char* evidence) {
    for (const Region& region : regions) {
      const double area_m2 = static_cast<double>(region.cells) * cell_area_m2;
      if (area_m2 < kAreaMinM2) continue;
      const Eigen::Vector2d size_m = terrain.cell_m * region.box.size().cast<double>();
      const Eigen::Vector2d p_level =
          terrain.p_level_corner + terrain.cell_m * region.box.from.cast<double>() + 0.5 * size_m;
      const bool roof = is_roof && std::isfinite(region.clearance_m);
      hazards.push_back(
          {kind, roof ? region.clearance_m : area_m2, roof ? "m" : "m²",
           fmt::format("3D scan {}: {} over {:.1f} m²", number, evidence, area_m2), terrain.utime,
           LevelPose{terrain.T_odom_level, z_m} * LevelPose{{p_level.x(), p_level.y(), 0.0}, 0.0},
           size_m});
    }
  };
  add_regions(
      "water",
      regions_of(terrain, [](const TerrainCell& cell) { return cell.ground == Ground::kNoReturn; }),
      false, "no return from the ground, as from water,");
  add_regions("low roof",
              regions_of(terrain,
                         [&vehicle](const TerrainCell& cell) {
                           return cell.ground == Ground::kObserved &&
                                  is_above_belly(cell.clearance_m, vehicle) &&
                                  cell.clearance_m < static_cast<float>(vehicle.height_m) &&
                                  cell.coefficient_m < static_cast<float>(vehicle.step_max_m);
                         }),
              true, "roof lower than the vehicle");
  return hazards;
}

std::optional<LevelPose> join(Hazard& hazard, const Hazard& observed,
                              const LevelPose& T_hazard_observed) {
  if (hazard.kind != observed.kind) return std::nullopt;
  const Eigen::Vector2d p_hazard = T_hazard_observed.plan.translation();
  const Eigen::Vector2d half_m = 0.5 * hazard.size_m;
  const Eigen::Vector2d half_new_m = 0.5 * observed.size_m;
  const Eigen::Vector2d gap_m = p_hazard.cwiseAbs() - half_m - half_new_m;
  if (gap_m.maxCoeff() > kNearM) return std::nullopt;
  const Eigen::Vector2d low = (-half_m).cwiseMin(p_hazard - half_new_m);
  const Eigen::Vector2d high = half_m.cwiseMax(p_hazard + half_new_m);
  const Eigen::Vector2d shift = 0.5 * (low + high);
  hazard.size_m = high - low;
  hazard.value = worse(hazard.kind, hazard.value, observed.value);
  return LevelPose{{shift.x(), shift.y(), 0.0}, 0.0};
}

}  // namespace adit

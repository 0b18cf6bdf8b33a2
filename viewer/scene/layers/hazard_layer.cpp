// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "viewer/scene/layers/hazard_layer.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include <fmt/format.h>

#include "common/bus/channels.hpp"
#include "common/bus/typed_messages.hpp"
#include "common/grid/grid2.hpp"
#include "common/messages/sensing.hpp"
#include "common/sensing/seconds.hpp"
#include "viewer/scene/foxglove_values.hpp"
#include "viewer/scene/topic_schema.hpp"

namespace adit {
namespace {

namespace values = foxglove_values;

constexpr std::int64_t kHazardsPeriodUs = 1'000'000;
constexpr double kMethaneMaxShare = 0.01;          // 30 CFR 75.323
constexpr double kOxygenMinShare = 0.195;          // 30 CFR 75.321
constexpr double kCarbonMonoxideMaxShare = 50e-6;  // 30 CFR 75.322
constexpr double kSinkageMinM = 0.05;              // less is the tread of the wheels
constexpr double kNearM = 1.0;                     // gap between observations of one hazard
constexpr double kPlaceM = 3.0;                    // extent of what is measured at the robot
constexpr double kAreaMinM2 = 0.5;                 // of ground without returns and of low roof
constexpr double kBoxHeightM = 0.3;

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
bool is_roof(double clearance_m, const Vehicle& vehicle) {
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

HazardLayer::HazardLayer(Bus& bus, TopicBoard& board, const MapFrame& frame,
                         const RobotLayer& robot, const Vehicle& vehicle)
    : board_(board), frame_(frame), robot_(robot), vehicle_(vehicle) {
  topic_ =
      board.add(protobuf_topic("/hazards", *foxglove::SceneUpdate::descriptor(), kHazardsPeriodUs),
                [this] { return hazards_message(); });
  subscribe<gas_t>(bus, channels::kGas, Delivery::latest(),
                   [this](const GasReading& reading) { on_gas(reading); });
  subscribe<sinkage_t>(bus, channels::kSinkage, Delivery::latest(),
                       [this](const SinkageReading& reading) { on_sinkage(reading); });
}

void HazardLayer::set_changed(std::int64_t utime) {
  utime_ = std::max(utime_, utime);
  board_.set_changed(topic_, utime_);
}

void HazardLayer::on_gas(const GasReading& reading) {
  if (reading.methane_share >= kMethaneMaxShare)
    add_at_robot("methane", 100.0 * reading.methane_share, "%", "measured there", reading.utime);
  if (reading.oxygen_share < kOxygenMinShare)
    add_at_robot("oxygen", 100.0 * reading.oxygen_share, "%", "measured there", reading.utime);
  if (reading.carbon_monoxide_share >= kCarbonMonoxideMaxShare) {
    add_at_robot("carbon monoxide", 1e6 * reading.carbon_monoxide_share, "ppm", "measured there",
                 reading.utime);
  }
}

void HazardLayer::on_sinkage(const SinkageReading& reading) {
  const double depth_m = *std::max_element(reading.depth_m.begin(), reading.depth_m.end());
  if (depth_m >= kSinkageMinM)
    add_at_robot("mud", depth_m, "m", "the wheels sank in", reading.utime);
}

void HazardLayer::add_at_robot(const std::string& kind, double value, const std::string& unit,
                               const std::string& evidence, std::int64_t utime) {
  if (!robot_.pose()) return;
  add({kind, value, unit, evidence, utime,
       frame_.anchored({robot_.pose()->T_odom_body, robot_.pose()->z_m}),
       Eigen::Vector2d::Constant(kPlaceM)});
}

void HazardLayer::add_path(const PlannedPath& path) {
  const double z_m = robot_.pose() ? robot_.pose()->z_m : 0.0;
  for (const BlockingCell& cell : path.blocking) {
    const auto hazard = hazard_of(cell.reason);
    if (!hazard) continue;
    if (cell.reason == BlockingCell::Reason::kRoof && !is_roof(cell.height_m, vehicle_)) continue;
    add({hazard->kind, cell.height_m, hazard->unit,
         fmt::format("blocks the path of plan {}", path.id), path.utime,
         frame_.anchored({{cell.p_odom.x(), cell.p_odom.y(), 0.0}, z_m}),
         Eigen::Vector2d::Constant(0.1)});
  }
}

void HazardLayer::add_terrain(const TerrainMap& terrain, int number) {
  const double cell_area_m2 = terrain.cell_m * terrain.cell_m;
  const double z_m = robot_.pose() ? robot_.pose()->z_m : 0.0;
  const auto add_regions = [&](const std::string& kind, const std::vector<Region>& regions,
                               const char* evidence) {
    for (const Region& region : regions) {
      const double area_m2 = static_cast<double>(region.cells) * cell_area_m2;
      if (area_m2 < kAreaMinM2) continue;
      const Eigen::Vector2d size_m = terrain.cell_m * region.box.size().cast<double>();
      const Eigen::Vector2d p_level =
          terrain.p_level_corner + terrain.cell_m * region.box.from.cast<double>() + 0.5 * size_m;
      const bool roof = std::isfinite(region.clearance_m) && kind == "low roof";
      add({kind, roof ? region.clearance_m : area_m2, roof ? "m" : "m²",
           fmt::format("3D scan {}: {} over {:.1f} m²", number, evidence, area_m2), terrain.utime,
           frame_.anchored(LevelPose{terrain.T_odom_level, z_m} *
                           LevelPose{{p_level.x(), p_level.y(), 0.0}, 0.0}),
           size_m});
    }
  };
  add_regions(
      "water",
      regions_of(terrain, [](const TerrainCell& cell) { return cell.ground == Ground::kNoReturn; }),
      "no return from the ground, as from water,");
  add_regions("low roof",
              regions_of(terrain,
                         [this](const TerrainCell& cell) {
                           return cell.ground == Ground::kObserved &&
                                  is_roof(cell.clearance_m, vehicle_) &&
                                  cell.clearance_m < static_cast<float>(vehicle_.height_m) &&
                                  cell.coefficient_m < static_cast<float>(vehicle_.step_max_m);
                         }),
              "roof lower than the vehicle");
}

/// Joins it with a hazard of its kind that it touches.
void HazardLayer::add(const Hazard& observed) {
  const LevelPose T_map_centre = frame_.T_map(observed.T_centre);
  for (Hazard& hazard : hazards_) {
    if (hazard.kind != observed.kind) continue;
    const LevelPose T_map_hazard = frame_.T_map(hazard.T_centre);
    const Eigen::Vector2d p_hazard = T_map_hazard.plan.inverse() * T_map_centre.plan.translation();
    const Eigen::Vector2d half_m = 0.5 * hazard.size_m;
    const Eigen::Vector2d half_new_m = 0.5 * observed.size_m;
    const Eigen::Vector2d gap_m = p_hazard.cwiseAbs() - half_m - half_new_m;
    if (gap_m.maxCoeff() > kNearM) continue;
    const Eigen::Vector2d low = (-half_m).cwiseMin(p_hazard - half_new_m);
    const Eigen::Vector2d high = half_m.cwiseMax(p_hazard + half_new_m);
    const Eigen::Vector2d shift = 0.5 * (low + high);
    hazard.T_centre.T_anchor =
        hazard.T_centre.T_anchor * LevelPose{{shift.x(), shift.y(), 0.0}, 0.0};
    hazard.size_m = high - low;
    hazard.value = worse(hazard.kind, hazard.value, observed.value);
    return set_changed(observed.utime);
  }
  if (hazards_.size() >= kHazardsMax) return;
  hazards_.push_back(observed);
  set_changed(observed.utime);
}

std::string HazardLayer::hazards_message() const {
  foxglove::SceneUpdate update = values::replacing_update(utime_);
  int number = 0;
  for (const Hazard& hazard : hazards_) {
    const LevelPose T_map_hazard = frame_.T_map(hazard.T_centre);
    foxglove::SceneEntity& entity =
        values::add_entity(update, utime_, fmt::format("{} {}", hazard.kind, ++number));
    const std::string value =
        std::isfinite(hazard.value) ? fmt::format("{:.2f}", hazard.value) : "";
    values::add_metadata(entity, "kind", hazard.kind);
    values::add_metadata(entity, "value", value);
    values::add_metadata(entity, "unit", hazard.unit);
    values::add_metadata(entity, "evidence", hazard.evidence);
    values::add_metadata(entity, "time_s", fmt::format("{:.3f}", seconds(hazard.utime)));
    foxglove::CubePrimitive& cube = *entity.add_cubes();
    values::set_pose(*cube.mutable_pose(), T_map_hazard);
    cube.mutable_size()->set_x(hazard.size_m.x());
    cube.mutable_size()->set_y(hazard.size_m.y());
    cube.mutable_size()->set_z(kBoxHeightM);
    const bool water = hazard.kind == "water";
    values::set_color(*cube.mutable_color(),
                      water ? values::Rgba{.r = 0.1, .g = 0.4, .b = 0.9, .a = 0.5}
                            : values::Rgba{.r = 0.9, .g = 0.3, .b = 0.1, .a = 0.5});
    values::add_text(
        entity, T_map_hazard.translation(),
        value.empty() ? hazard.kind : fmt::format("{} {} {}", hazard.kind, value, hazard.unit));
  }
  return update.SerializeAsString();
}

}  // namespace adit

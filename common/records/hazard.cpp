// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "common/records/hazard.hpp"

#include <algorithm>
#include <cmath>
#include <span>

#include <fmt/format.h>

namespace adit {
namespace {

constexpr double kMethaneMaxShare = 0.01;          // 30 CFR 75.323
constexpr double kOxygenMinShare = 0.195;          // 30 CFR 75.321
constexpr double kCarbonMonoxideMaxShare = 50e-6;  // 30 CFR 75.322
constexpr double kSinkageMinM = 0.05;              // less is the tread of the wheels
constexpr double kNearM = 1.0;                     // gap between observations of one hazard
constexpr double kRoofReachM = 0.35;               // around a cell with a low roof
constexpr int kRoofCellsMin = 4;                   // of low roof within that
constexpr std::size_t kBlockingCellsMax = 3000;    // planning sends fewer
constexpr double kPlaceM = 3.0;                    // extent of what is measured at the robot

/// What of a blocking cell is known, in words and with its unit.
struct CellHazard {
  const char* kind;
  const char* unit;
};

/// Nothing is said of cells whose ground was not observed: that beams passed over it or had no
/// return has more causes than a drop and water (see terrain_hazards.hpp).
std::optional<CellHazard> hazard_of(BlockingCell::Reason reason) {
  using Reason = BlockingCell::Reason;
  switch (reason) {
    case Reason::kStep:
    case Reason::kBelly:
      return CellHazard{"step", "m"};
    case Reason::kRoof:
      return CellHazard{"low roof", "m"};
    case Reason::kSlope:
      return CellHazard{"slope", "m"};
    case Reason::kWater:
    case Reason::kDrop:
    case Reason::kUnknown:
      break;
  }
  return std::nullopt;
}

/// Whether a cell shows a low roof, rather than a rib or the wall that leans over its foot: those
/// are a cell or two wide.
bool is_low_roof(const BlockingCell& cell, std::span<const BlockingCell> blocking,
                 const Vehicle& vehicle) {
  if (!is_above_belly(cell.height_m, vehicle)) return false;
  const auto alike =
      std::count_if(blocking.begin(), blocking.end(), [&](const BlockingCell& other) {
        return other.reason == BlockingCell::Reason::kRoof &&
               is_above_belly(other.height_m, vehicle) &&
               (other.p_odom - cell.p_odom).norm() < kRoofReachM;
      });
  return alike >= kRoofCellsMin;
}

/// The worse of two values: the lower roof, otherwise the larger value.
double worse(const std::string& kind, double a, double b) {
  if (!std::isfinite(a) || !std::isfinite(b)) return std::isfinite(a) ? a : b;
  return kind == "low roof" || kind == "oxygen" ? std::min(a, b) : std::max(a, b);
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
  const auto blocking =
      std::span(path.blocking).first(std::min(path.blocking.size(), kBlockingCellsMax));
  for (const BlockingCell& cell : blocking) {
    const auto hazard = hazard_of(cell.reason);
    if (!hazard) continue;
    if (cell.reason == BlockingCell::Reason::kRoof && !is_low_roof(cell, blocking, vehicle))
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

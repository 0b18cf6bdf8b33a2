// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "procs/mission/mission_limits.hpp"

#include <algorithm>

#include <fmt/format.h>

#include "common/pose_graph/map_correction.hpp"
#include "common/sensing/seconds.hpp"

namespace adit {
namespace {

constexpr double kForgettingFactor =
    0.995;                      // per scan, of the share of lost scans: about 200 scans
constexpr int kPointsMin = 60;  // a laser that faces an open space returns fewer
constexpr double kBatteryBaselineM = 100.0;  // over which the charge per metre is measured
constexpr double kSlowestM_s = 0.05;         // including stops for scans

}  // namespace

void MissionLimits::require_return(const std::string& reason) {
  if (!reason_) reason_ = reason;
}

void MissionLimits::add(const GasReading& gas) {
  if (gas.methane_share > params_.methane_max_share) {
    require_return(fmt::format("{:.2f} % of methane in the air", 100.0 * gas.methane_share));
  } else if (gas.oxygen_share < params_.oxygen_min_share) {
    require_return(fmt::format("only {:.1f} % of oxygen in the air", 100.0 * gas.oxygen_share));
  } else if (gas.carbon_monoxide_share > params_.carbon_monoxide_max_share) {
    require_return(
        fmt::format("{:.0f} ppm of carbon monoxide in the air", 1e6 * gas.carbon_monoxide_share));
  }
}

void MissionLimits::add(const SinkageReading& sinkage) {
  const double deepest = *std::max_element(sinkage.depth_m.begin(), sinkage.depth_m.end());
  if (deepest > params_.sinkage_max_m) {
    require_return(fmt::format("a wheel is {:.2f} m deep in the ground", deepest));
  }
}

void MissionLimits::add(const VehicleState& state) {
  if (!battery_start_share_) battery_start_share_ = state.battery_share;
  battery_share_ = state.battery_share;
}

/// Lost scans count only while the robot moves. Unmeasured motion counts also while it stands, as
/// only a measurement shows that it stands.
void MissionLimits::add(const ScanMatch& match, bool robot_moves) {
  if (robot_moves) count_lost(match);
  count_unmeasured(match);
}

/// One scan that measures all directions resets the count: it is matched against the same reference
/// as the scans before it.
void MissionLimits::count_unmeasured(const ScanMatch& match) {
  if (match.status != ScanMatch::Status::kMatched) return;
  if (!has_unobserved_direction(match)) {
    unmeasured_utime_.reset();
    unmeasured_s_ = 0.0;
    return;
  }
  if (!unmeasured_utime_) unmeasured_utime_ = match.utime;
  unmeasured_s_ = seconds(match.utime - *unmeasured_utime_);
  if (is_unmeasured()) {
    require_return(
        fmt::format("no sensor measured the motion in one direction for {:.0f} s", unmeasured_s_));
  }
}

void MissionLimits::count_lost(const ScanMatch& match) {
  if (match.points < kPointsMin) return;
  const bool lost = match.status == ScanMatch::Status::kLost;
  lost_share_ = kForgettingFactor * lost_share_ + (1.0 - kForgettingFactor) * (lost ? 1.0 : 0.0);
  if (lost_share_ > params_.lost_scans_max_share) {
    require_return(fmt::format("{:.0f} % of the last scans do not match", 100.0 * lost_share_));
  }
}

void MissionLimits::add(const MapCorrection& correction) {
  const double sd_m = position_sd_m(correction).value_or(0.0);
  if (sd_m > params_.map_sd_max_m) {
    require_return(fmt::format("the standard deviation of the map is {:.1f} m here", sd_m));
  }
}

void MissionLimits::add_disk_failure(const std::string& reason) {
  if (!reason.empty()) require_return(reason);
}

double MissionLimits::remaining_m(double elapsed_s, double distance_travelled_m) const {
  double remaining = params_.path_length_max_m - distance_travelled_m;
  const double speed = elapsed_s > 0.0 ? distance_travelled_m / elapsed_s : 0.0;
  remaining = std::min(remaining, (params_.time_max_s - elapsed_s) * std::max(speed, kSlowestM_s));
  if (battery_share_) {
    double per_m = params_.battery_share_per_m;
    const double path_length_m = distance_travelled_m - battery_start_distance_m_;
    if (path_length_m > kBatteryBaselineM) {
      per_m = std::max(0.0, (*battery_start_share_ - *battery_share_) / path_length_m);
    }
    const double left = *battery_share_ - params_.battery_reserve_share;
    if (per_m > 0.0) remaining = std::min(remaining, left / per_m);
  }
  return std::max(0.0, remaining);
}

}  // namespace adit

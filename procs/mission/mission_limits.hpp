// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "common/config/bounds.hpp"
#include "common/pose_graph/map_correction.hpp"
#include "common/sensing/scan_match.hpp"
#include "common/sensing/vehicle_readings.hpp"
#include "common/types/vehicle_state.hpp"

namespace adit {

/// When a mission turns around. Limits of air and ground are below those at which the guard stops
/// the robot.
struct MissionLimitsParams {
  double path_length_max_m = 5000.0;  ///< of the complete mission
  double time_max_s = 28800.0;
  double battery_reserve_share = 0.2;   ///< left at home
  double battery_share_per_m = 0.0002;  ///< until it is measured over 100 m
  double methane_max_share = 0.005;     ///< a tenth of the lower explosive limit
  double oxygen_min_share = 0.2;
  double carbon_monoxide_max_share = 30e-6;
  double sinkage_max_m = 0.1;
  double lost_scans_max_share = 0.5;  ///< of the last 200 scans, about
  double map_sd_max_m = 5.0;          ///< standard deviation of the newest local map's position
  double unmeasured_max_s = 10.0;     ///< without a measurement of motion in some direction
  double disk_free_min_mb = 200.0;    ///< on the disk of the journals; 0: not watched

  template <class V>
  void visit(V& v) {
    v("path_length_max_m", path_length_max_m, above(0.0));
    v("time_max_s", time_max_s, above(0.0));
    v("battery_reserve_share", battery_reserve_share, within(0.0, 0.9));
    v("battery_share_per_m", battery_share_per_m, within(0.0, 0.1));
    v("methane_max_share", methane_max_share, within(0.0, 1.0));
    v("oxygen_min_share", oxygen_min_share, within(0.0, 1.0));
    v("carbon_monoxide_max_share", carbon_monoxide_max_share, within(0.0, 1.0));
    v("sinkage_max_m", sinkage_max_m, above(0.0));
    v("lost_scans_max_share", lost_scans_max_share, above_up_to(0.0, 1.0));
    v("map_sd_max_m", map_sd_max_m, above(0.0));
    v("unmeasured_max_s", unmeasured_max_s, above(0.0));
    v("disk_free_min_mb", disk_free_min_mb, at_least(0.0));
  }
};

/// The path length that a mission has left, and the reason to return home.
class MissionLimits {
 public:
  explicit MissionLimits(const MissionLimitsParams& params) : params_(params) {}

  /// After a restart: the distance travelled before the first battery state is received [m].
  void begin(double distance_travelled_m) { battery_start_distance_m_ = distance_travelled_m; }

  void add(const GasReading& gas);
  void add(const SinkageReading& sinkage);
  void add(const VehicleState& state);
  void add(const ScanMatch& match, bool robot_moves);
  void add(const MapCorrection& correction);
  /// Space is short on the disk of the journals, or it fails: why, a sentence; empty if neither.
  void add_disk_failure(const std::string& reason);

  /// Why the robot must return home, a sentence. The first reason stays.
  [[nodiscard]] const std::optional<std::string>& reason() const { return reason_; }
  /// Whether no sensor measured some direction of motion for `unmeasured_max_s`.
  [[nodiscard]] bool is_unmeasured() const { return unmeasured_s_ > params_.unmeasured_max_s; }
  /// Path length that time, battery and `path_length_max_m` still allow [m].
  [[nodiscard]] double remaining_m(double elapsed_s, double distance_travelled_m) const;

 private:
  void count_lost(const ScanMatch& match);
  void count_unmeasured(const ScanMatch& match);
  void require_return(const std::string& reason);

  MissionLimitsParams params_;
  std::optional<std::string> reason_;
  std::optional<double> battery_share_;
  std::optional<double> battery_start_share_;
  double battery_start_distance_m_ = 0.0;  ///< distance travelled then
  double lost_share_ = 0.0;
  std::optional<std::int64_t> unmeasured_utime_;  ///< since when a direction is unmeasured
  double unmeasured_s_ = 0.0;                     ///< for how long
};

}  // namespace adit

// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "common/config/bounds.hpp"
#include "common/sensing/scan_match.hpp"
#include "common/types/mission.hpp"
#include "common/types/vehicle_state.hpp"

namespace adit {

struct LocalizationMonitorParams {
  double pose_age_max_s = 0.25;  ///< maximum age of the newest pose
  double lost_max_s = 0.5;       ///< maximum time for which scan matching may be lost

  template <class V>
  void visit(V& v) {
    v("pose_age_max_s", pose_age_max_s, above_up_to(0.0, 1.0));
    v("lost_max_s", lost_max_s, within(0.0, 5.0));
  }
};

/// Whether the robot is localized. Without any scan match the poses alone count, as they may come
/// from another source.
class LocalizationMonitor {
 public:
  explicit LocalizationMonitor(const LocalizationMonitorParams& params) : params_(params) {}

  /// A lost match counts from its time until the next match of any laser.
  void add_match(std::int64_t utime, ScanMatch::Status status);

  /// Why the robot is not localized at a time, given the time of the newest pose; nothing if it is.
  [[nodiscard]] std::optional<std::string> lost_reason(
      std::int64_t utime, const std::optional<std::int64_t>& pose_utime) const;

 private:
  LocalizationMonitorParams params_;
  std::optional<std::int64_t> lost_utime_;
};

/// Whether the mission permits driving: in its phase execute, along the path of its goal. Before
/// the first mission phase is received, any path may be driven.
class MissionPermission {
 public:
  /// Maximum age of the newest mission phase, which is published each second.
  static constexpr std::int64_t kTimeoutUs = 3'500'000;

  /// `utime` is the bus time of the reception.
  void update(const MissionPhase& phase, std::int64_t utime);
  /// Why a path must not be driven now; nothing if it may.
  [[nodiscard]] std::optional<std::string> denial_reason(std::int64_t utime,
                                                         std::int32_t path_id) const;

 private:
  std::optional<MissionPhase> phase_;
  std::int64_t utime_ = 0;  ///< bus time of the reception
};

/// The newest state that the vehicle has published, while it is fresh. It is optional: some
/// vehicles publish none.
class VehicleFeedback {
 public:
  static constexpr double kTimeoutS = 0.25;         ///< the state is published ten times a second
  static constexpr double kAccelerationM_S2 = 1.0;  ///< maximum, braking included
  static constexpr double kPredictionS = 0.05;      ///< prediction horizon of the speed

  void update(const VehicleState& state) { state_ = state; }

  /// The predicted speed, given the commanded one: the commanded speed, limited to what the vehicle
  /// can reach from its measured speed. A vehicle that is held has its measured speed; without a
  /// fresh state the commanded speed is assumed.
  [[nodiscard]] double speed_m_s(std::int64_t utime, double commanded_m_s) const;
  /// Why the vehicle does not execute commands; nothing if it does.
  [[nodiscard]] std::optional<std::string> hold_reason(std::int64_t utime) const;

 private:
  [[nodiscard]] bool is_fresh(std::int64_t utime) const;

  std::optional<VehicleState> state_;
};

/// Whether the robot may move now: it is localized, the mission permits its path, and the vehicle
/// executes commands.
class MotionPermission {
 public:
  explicit MotionPermission(const LocalizationMonitorParams& params) : localization_(params) {}

  void add_match(const ScanMatch& match) { localization_.add_match(match.utime, match.status); }
  void add_phase(const MissionPhase& phase, std::int64_t utime) { mission_.update(phase, utime); }
  void add_state(const VehicleState& state) { vehicle_.update(state); }

  /// Reevaluates both reasons below for a path.
  void update(std::int64_t utime, const std::optional<std::int64_t>& pose_utime,
              std::int32_t path_id);

  /// Why the robot must stop: it is not localized, or the mission does not permit the path.
  [[nodiscard]] const std::optional<std::string>& denial_reason() const { return denial_reason_; }
  /// Why the vehicle is held although the robot may move.
  [[nodiscard]] const std::optional<std::string>& hold_reason() const { return hold_reason_; }
  [[nodiscard]] const VehicleFeedback& vehicle() const { return vehicle_; }

 private:
  LocalizationMonitor localization_;
  MissionPermission mission_;
  VehicleFeedback vehicle_;
  std::optional<std::string> denial_reason_;
  std::optional<std::string> hold_reason_;
};

}  // namespace adit

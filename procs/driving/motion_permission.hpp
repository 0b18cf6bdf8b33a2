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
  double pose_age_max_s = 0.25;  ///< of the newest pose
  double lost_max_s = 0.5;       ///< for which scan matching may be lost

  template <class V>
  void visit(V& v) {
    v("pose_age_max_s", pose_age_max_s, above_up_to(0.0, 1.0));
    v("lost_max_s", lost_max_s, within(0.0, 5.0));
  }
};

/// Whether the robot knows where it is. Without any word from scan matching the poses themselves
/// are trusted: they may come from elsewhere.
class LocalizationMonitor {
 public:
  explicit LocalizationMonitor(const LocalizationMonitorParams& params) : params_(params) {}

  /// A lost match counts from its time until one of any laser is matched.
  void add_match(std::int64_t utime, ScanMatch::Status status);

  /// Why it does not know it, at a time and with the time of the newest pose; nothing if it does.
  [[nodiscard]] std::optional<std::string> lost_reason(
      std::int64_t utime, const std::optional<std::int64_t>& pose_utime) const;

 private:
  LocalizationMonitorParams params_;
  std::optional<std::int64_t> lost_utime_;
};

/// Whether the mission lets the robot drive: in its phase execute, along the path that it means.
/// Where no mission was ever heard, anybody's path is driven.
class MotionPermission {
 public:
  /// How old the newest word of the mission may be: it comes each second.
  static constexpr std::int64_t kTimeoutUs = 3'500'000;

  void update(const MissionPhase& phase, std::int64_t utime);
  /// Why a path may not be driven now; nothing where it may.
  [[nodiscard]] std::optional<std::string> denial_reason(std::int64_t utime,
                                                         std::int32_t path_id) const;

 private:
  std::optional<MissionPhase> phase_;
  std::int64_t utime_ = 0;  ///< bus time at which it was heard
};

/// What the vehicle said of itself last, as long as that is fresh; some vehicles say nothing.
class VehicleFeedback {
 public:
  static constexpr double kTimeoutS = 0.25;         ///< of what comes ten times a second
  static constexpr double kAccelerationM_S2 = 1.0;  ///< at most, as brakes as well
  static constexpr double kPredictionS = 0.05;      ///< for which it is predicted

  void update(const VehicleState& state) { state_ = state; }

  /// From now on, where it is commanded to have a speed: that speed, as far as it can have come to
  /// it since it said its own. Held it has its own, and of one that is silent nothing else is
  /// known.
  [[nodiscard]] double speed_m_s(std::int64_t utime, double commanded_m_s) const;
  /// Why it stands whatever it is told, for people; nothing where it is not held.
  [[nodiscard]] std::optional<std::string> hold_reason(std::int64_t utime) const;

 private:
  [[nodiscard]] bool is_fresh(std::int64_t utime) const;

  std::optional<VehicleState> state_;
};

}  // namespace adit

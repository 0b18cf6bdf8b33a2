// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <optional>

#include "common/sensing/seconds.hpp"
#include "common/types/vehicle_state.hpp"

namespace adit {

/// How far the body may be from where the mission began, by the speed of its wheels: it is not
/// farther than they rolled, in either direction. Unlike the pose this holds without odometry,
/// where scans leave a direction unobserved.
class RolledDistance {
 public:
  void add(const VehicleState& state) {
    if (!std::isfinite(state.speed_m_s)) is_complete_ = false;
    if (state_) {
      const double dt_s = seconds(state.utime - state_->utime);
      if (dt_s <= 0.0) return;
      if (dt_s > kGapMaxS) is_complete_ = false;
      const double speed_m_s = std::max(std::abs(state.speed_m_s), std::abs(state_->speed_m_s));
      distance_m_ += speed_m_s * dt_s;
    }
    state_ = state;
  }

  /// After a restart of the mission: what was rolled before is unknown.
  void invalidate() { is_complete_ = false; }

  /// Bound of the distance from the start [m], with a margin for the error of the speed and for
  /// stopping. Empty before the first state, and after a gap.
  [[nodiscard]] std::optional<double> bound_m() const {
    if (!state_ || !is_complete_) return std::nullopt;
    return (1.0 + kSpeedErrorShare) * distance_m_ + kStoppingM;
  }

 private:
  static constexpr double kGapMaxS = 0.5;
  static constexpr double kSpeedErrorShare = 0.1;
  static constexpr double kStoppingM = 0.15;

  std::optional<VehicleState> state_;
  double distance_m_ = 0.0;
  bool is_complete_ = true;
};

}  // namespace adit

// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "common/vehicle/drive_command.hpp"

namespace adit {

/// What the vehicle said of itself last, as long as that is fresh; some vehicles say nothing.
class HeardVehicle {
 public:
  static constexpr double kFreshS = 0.25;           ///< of what comes ten times a second
  static constexpr double kAccelerationM_S2 = 1.0;  ///< at most, as brakes as well
  static constexpr double kAheadS = 0.05;           ///< for which it is predicted

  void hear(const VehicleState& state) { state_ = state; }

  /// From now on, where it is commanded to have a speed: that speed, as far as it can have come to
  /// it since it said its own. Held it has its own, and of one that is silent nothing else is
  /// known.
  [[nodiscard]] double speed_m_s(std::int64_t utime, double commanded_m_s) const;
  /// Why it stands whatever it is told, for people; nothing where it is not held.
  [[nodiscard]] std::optional<std::string> hold(std::int64_t utime) const;

 private:
  [[nodiscard]] bool is_fresh(std::int64_t utime) const;

  std::optional<VehicleState> state_;
};

}  // namespace adit

// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "procs/driving/heard_vehicle.hpp"

#include <algorithm>
#include <cmath>

#include "common/sensing/seconds.hpp"

namespace adit {

double HeardVehicle::speed_m_s(std::int64_t utime, double commanded_m_s) const {
  if (!is_fresh(utime)) return commanded_m_s;
  if (hold(utime)) return state_->speed_m_s;
  const double since_s = std::abs(seconds(utime - state_->utime));
  const double most = kAccelerationM_S2 * (since_s + kAheadS);
  return state_->speed_m_s + std::clamp(commanded_m_s - state_->speed_m_s, -most, most);
}

std::optional<std::string> HeardVehicle::hold(std::int64_t utime) const {
  if (!is_fresh(utime)) return std::nullopt;
  if (state_->stopped) return "held by a stop order";
  if (state_->expired) return "held because commands come too late";
  return std::nullopt;
}

/// A time that went back, or one to come, is not that of the vehicle.
bool HeardVehicle::is_fresh(std::int64_t utime) const {
  return state_ && std::abs(seconds(utime - state_->utime)) <= kFreshS;
}

}  // namespace adit

// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "common/messages/vehicle_state.hpp"

#include "common/messages/checks.hpp"

namespace adit {

vehicle_state_t to_message(const VehicleState& state) {
  vehicle_state_t message;
  message.utime = state.utime;
  message.speed_m_s = state.speed_m_s;
  message.curvature_1_m = state.curvature_1_m;
  message.battery_share = state.battery_share;
  message.stopped = static_cast<std::int8_t>(state.stopped);
  message.expired = static_cast<std::int8_t>(state.expired);
  return message;
}

Result<VehicleState> from_message(const vehicle_state_t& message) {
  if (!is_plausible_utime(message.utime)) return Refused{kImplausibleTime};
  if (!std::isfinite(message.speed_m_s)) return Refused{"speed is not finite"};
  if (!std::isfinite(message.curvature_1_m)) return Refused{"curvature is not finite"};
  if (!is_share(message.battery_share)) return Refused{kNoShare};
  return VehicleState{message.utime,         message.speed_m_s,    message.curvature_1_m,
                      message.battery_share, message.stopped != 0, message.expired != 0};
}

}  // namespace adit

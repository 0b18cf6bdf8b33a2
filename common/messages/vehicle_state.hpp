// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "adit/vehicle_state_t.hpp"

#include "common/messages/result.hpp"
#include "common/vehicle/drive_command.hpp"

namespace adit {

vehicle_state_t to_message(const VehicleState& state);

/// Refused: an implausible time, a speed or curvature that is not finite, a share beyond 0 to 1.
Result<VehicleState> from_message(const vehicle_state_t& message);

}  // namespace adit

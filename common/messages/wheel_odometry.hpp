// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "adit/wheel_odometry_t.hpp"

#include "common/messages/result.hpp"
#include "common/sensing/wheel_odometry.hpp"

namespace adit {

/// The rates, which WheelOdometry does not hold, are NaN on the wire.
wheel_odometry_t to_message(const WheelOdometry& odometry);

/// Refused: an implausible time, a pose that is not finite. The rates are not looked at.
Result<WheelOdometry> from_message(const wheel_odometry_t& message);

}  // namespace adit

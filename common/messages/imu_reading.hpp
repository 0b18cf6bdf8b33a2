// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "adit/imu_t.hpp"

#include "common/messages/result.hpp"
#include "common/sensing/imu_reading.hpp"

namespace adit {

/// Without an orientation, which ImuReading does not hold.
imu_t to_message(const ImuReading& reading);

/// Refused: an implausible time, rates or accelerations that are not finite.
Result<ImuReading> from_message(const imu_t& message);

}  // namespace adit

// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "adit/tilt_t.hpp"

#include "common/messages/result.hpp"
#include "common/sensing/tilt_reading.hpp"

namespace adit {

tilt_t to_message(const TiltReading& reading);

/// Refused: an implausible time, an angle or rate that is not finite.
Result<TiltReading> from_message(const tilt_t& message);

}  // namespace adit

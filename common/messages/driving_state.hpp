// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "adit/driving_state_t.hpp"

#include "common/messages/result.hpp"
#include "common/path/driving_state.hpp"

namespace adit {

driving_state_t to_message(const DrivingState& state);

/// Refused: an implausible time, a negative id, an unknown state, a way that is negative or not
/// finite, an error that is not finite.
Result<DrivingState> from_message(const driving_state_t& message);

}  // namespace adit

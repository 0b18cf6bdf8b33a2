// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "adit/run_state_t.hpp"

#include "common/messages/result.hpp"
#include "common/vehicle/run_state.hpp"

namespace adit {

run_state_t to_message(const RunState& state);

/// Refused: an implausible time, a way that is negative or not finite.
Result<RunState> from_message(const run_state_t& message);

}  // namespace adit

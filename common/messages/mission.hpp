// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "adit/mission_order_t.hpp"
#include "adit/phase_t.hpp"

#include "common/messages/result.hpp"
#include "common/types/mission.hpp"

namespace adit {

phase_t to_message(const MissionPhase& phase);

/// Refused: an implausible time, a phase, outcome or laser that there is not, numbers that are not
/// finite or negative.
Result<MissionPhase> from_message(const phase_t& message);

mission_order_t to_message(const MissionOrder& order);

/// Refused: an implausible time, an order that there is not.
Result<MissionOrder> from_message(const mission_order_t& message);

}  // namespace adit

// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "adit/mission_order_t.hpp"
#include "adit/phase_t.hpp"

#include "common/messages/result.hpp"
#include "common/types/mission.hpp"

namespace adit {

phase_t to_message(const MissionPhase& phase);

/// Rejects an implausible time, an unknown phase, outcome or laser, and numbers that are negative
/// or not finite.
Result<MissionPhase> from_message(const phase_t& message);

mission_order_t to_message(const MissionOrder& order);

/// Rejects an implausible time and an unknown order.
Result<MissionOrder> from_message(const mission_order_t& message);

}  // namespace adit

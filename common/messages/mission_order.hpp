// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "adit/mission_order_t.hpp"

#include "common/messages/result.hpp"
#include "common/mission/mission_order.hpp"

namespace adit {

mission_order_t to_message(const MissionOrder& order);

/// Refused: an implausible time, an order that there is not.
Result<MissionOrder> from_message(const mission_order_t& message);

}  // namespace adit

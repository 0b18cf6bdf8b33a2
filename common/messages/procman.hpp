// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "procman_lcm/deputy_info_t.hpp"
#include "procman_lcm/discovery_t.hpp"
#include "procman_lcm/orders_t.hpp"
#include "procman_lcm/output_t.hpp"

#include "common/messages/result.hpp"
#include "common/types/procman.hpp"

namespace adit {

procman_lcm::deputy_info_t to_message(const ProcmanInfo& info);
procman_lcm::orders_t to_message(const ProcmanOrders& orders);
procman_lcm::output_t to_message(const ProcmanOutput& output);
procman_lcm::discovery_t to_message(const ProcmanDiscovery& discovery);

/// Rejects an implausible time, an empty deputy, a load or usage that is negative or not finite, a
/// negative process id, and invalid commands as in orders_t.
Result<ProcmanInfo> from_message(const procman_lcm::deputy_info_t& message);

/// Rejects an implausible time, an empty deputy or sheriff, a command without a name, an unknown
/// stop signal, a stop time that is negative or not finite.
Result<ProcmanOrders> from_message(const procman_lcm::orders_t& message);

/// Rejects an implausible time, an empty deputy, a text of a command without a name.
Result<ProcmanOutput> from_message(const procman_lcm::output_t& message);

/// Rejects an implausible time.
Result<ProcmanDiscovery> from_message(const procman_lcm::discovery_t& message);

}  // namespace adit

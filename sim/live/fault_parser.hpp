// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include "sim/simulation/simulation_params.hpp"

namespace adit {

/// Parses a fault of a command line, KIND[:TARGET][=AMOUNT]@SECONDS, for example
/// `laser_dies:front@20`, `packet_loss=0.1@5`, `kill:mapping@60`. Throws std::invalid_argument with
/// the reason.
FaultDescription parse_fault(const std::string& text);

/// Throws std::invalid_argument for a fault with a missing or invalid target or amount.
void require_complete(const FaultDescription& fault);

/// Whether the fault affects a process, not the robot.
bool is_process_fault(const FaultDescription& fault);

/// Throws std::invalid_argument, in one line, for faults of processes, which a run in a single
/// process cannot have.
void reject_process_faults(const std::vector<FaultDescription>& faults);

}  // namespace adit

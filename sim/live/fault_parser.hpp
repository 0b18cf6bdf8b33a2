// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include "sim/simulation/simulation_params.hpp"

namespace adit {

/// A fault as it stands on a command line: KIND[:TARGET][=AMOUNT]@SECONDS, for example
/// `laser_dies:front@20`, `packet_loss=0.1@5`, `kill:mapping@60`. Throws std::invalid_argument with
/// what is wrong with it.
FaultDescription parse_fault(const std::string& text);

/// Throws std::invalid_argument for a fault without the target or amount that its kind needs, or
/// with one that makes no sense.
void require_complete(const FaultDescription& fault);

/// Whether it is something that happens to a process and not to the robot.
bool is_process_fault(const FaultDescription& fault);

/// Throws std::invalid_argument, in one line, if one is: there are no other processes where all
/// runs in one.
void reject_process_faults(const std::vector<FaultDescription>& faults);

}  // namespace adit

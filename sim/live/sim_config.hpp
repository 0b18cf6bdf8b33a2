// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "common/config/config_file.hpp"
#include "sim/simulation/simulation_params.hpp"
#include "sim/world/world_description.hpp"

namespace adit {

/// Loads a config file; an empty path gives one without sections. Throws ConfigError.
ConfigFile load_config(const std::filesystem::path& path);

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

/// The section `sim` of a config file with additional faults (parse_fault()). Throws ConfigError
/// for the file and std::invalid_argument for a fault.
SimulationParams load_simulation_params(const std::filesystem::path& config,
                                        const std::vector<std::string>& faults);

/// The parameters in effect and the world, for the message CONFIG in logs.
std::string yaml_in_effect(const SimulationParams& params, const WorldDescription& world);

}  // namespace adit

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

/// The section `sim` of a config file with additional faults (parse_fault()). Throws ConfigError
/// for the file and std::invalid_argument for a fault.
SimulationParams load_simulation_params(const std::filesystem::path& config,
                                        const std::vector<std::string>& faults);

/// The parameters in effect and the world, for the message CONFIG in logs.
std::string yaml_in_effect(const SimulationParams& params, const WorldDescription& world);

}  // namespace adit

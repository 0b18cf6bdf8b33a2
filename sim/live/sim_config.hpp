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

/// A config file as any stage takes it; one without sections for an empty path. Throws ConfigError.
ConfigFile load_config(const std::filesystem::path& path);

/// The section `sim` of a config file, and more faults, as parse_fault takes them. Throws
/// ConfigError for the file and std::invalid_argument for a fault.
SimulationParams load_simulation_params(const std::filesystem::path& config,
                                        const std::vector<std::string>& faults);

/// All that is in effect, the mine included, for CONFIG: a log explains itself by it.
std::string yaml_in_effect(const SimulationParams& params, const WorldDescription& world);

}  // namespace adit

// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "sim/live/pacing.hpp"
#include "sim/simulation/simulation_params.hpp"

namespace adit {

/// A run of the simulator on LCM.
struct LiveRunOptions {
  std::string program;  ///< that speaks on standard error
  std::string world;    ///< as find_world takes it
  std::optional<int> seed;
  PacingParams pacing{.factor = 1.0, .wait_for = {}};
  std::filesystem::path config;     ///< empty: defaults
  std::vector<std::string> faults;  ///< as parse_fault takes them, besides those in the config
  std::string lcm_url;
  std::optional<double> for_s;  ///< of simulated time; until it is stopped without
};

/// The section `sim` of a config file, with more faults. Throws ConfigError for the file and
/// std::invalid_argument for a fault.
SimulationParams load_simulation_params(const std::filesystem::path& config,
                                        const std::vector<std::string>& faults);

/// Runs the simulator until SIGINT, SIGTERM or its time is up. A run that failed goes on, standing
/// still. Throws for what cannot be run.
void run_live(const LiveRunOptions& options);

}  // namespace adit

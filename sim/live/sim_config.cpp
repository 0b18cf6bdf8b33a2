// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "sim/live/sim_config.hpp"

#include "common/bus/node/stages.hpp"
#include "common/config/config.hpp"
#include "common/files/file_utils.hpp"
#include "sim/live/fault_parser.hpp"
#include "sim/world/world_file.hpp"

namespace adit {

ConfigFile load_config(const std::filesystem::path& path) {
  if (path.empty()) return {};
  ConfigFile file = ConfigFile::load(find_installed_file(path, "config"));
  file.require_known_sections(config_sections());
  return file;
}

SimulationParams load_simulation_params(const std::filesystem::path& config,
                                        const std::vector<std::string>& faults) {
  auto params = load_section<SimulationParams>(load_config(config), kSimSection);
  for (const FaultDescription& fault : params.faults) require_complete(fault);
  for (const std::string& fault : faults) params.faults.push_back(parse_fault(fault));
  return params;
}

std::string yaml_in_effect(const SimulationParams& params, const WorldDescription& world) {
  return to_yaml(params, kSimSection) + to_world_file(world);
}

}  // namespace adit

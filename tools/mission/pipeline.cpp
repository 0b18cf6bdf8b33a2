// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "tools/mission/pipeline.hpp"

#include <string>
#include <utility>

#include <fmt/format.h>

#include "common/config/config.hpp"
#include "procs/driving/driving_node.hpp"
#include "procs/exploration/exploration_node.hpp"
#include "procs/guard/guard_node.hpp"
#include "procs/mapping/mapping_node.hpp"
#include "procs/mission/mission_node.hpp"
#include "procs/planning/planning_node.hpp"
#include "procs/scan_assembly/scan_assembly_node.hpp"
#include "procs/scan_matching/scan_matching_node.hpp"
#include "procs/terrain/terrain_node.hpp"
#include "procs/volume_map/volume_map_node.hpp"

namespace adit {
namespace {

class Configurator {
 public:
  Configurator(const ConfigFile& config, const Lasers& lasers, const Vehicle& vehicle,
               const std::filesystem::path& journals)
      : config_(config), lasers_(lasers), vehicle_(vehicle), journals_(journals) {}

  template <class Node>
  void add(const std::string& stage) {
    auto params = load_section<typename Node::Params>(config_, stage);
    if constexpr (requires { params.lasers; }) params.lasers = lasers_;
    if constexpr (requires { params.vehicle; }) params.vehicle = vehicle_;
    if constexpr (requires { params.lasers_tilt; }) params.lasers_tilt = !lasers_.lidar.present;
    // CONFIG has the name of the journal without its folder.
    if constexpr (requires { params.journal; }) params.journal = fmt::format("{}.journal", stage);
    const std::string yaml = to_yaml(params, stage);
    if constexpr (requires { params.journal; }) {
      params.journal = journals_.empty() ? "" : (journals_ / params.journal).string();
    }
    nodes_.push_back(configured_node<Node>(stage, yaml, params));
  }

  [[nodiscard]] std::vector<ConfiguredNode> nodes() && { return std::move(nodes_); }

 private:
  const ConfigFile& config_;
  const Lasers& lasers_;
  const Vehicle& vehicle_;
  const std::filesystem::path& journals_;
  std::vector<ConfiguredNode> nodes_;
};

}  // namespace

std::vector<ConfiguredNode> configure_pipeline(const ConfigFile& config, const Lasers& lasers,
                                               const Vehicle& vehicle,
                                               const std::filesystem::path& journals) {
  Configurator configurator(config, lasers, vehicle, journals);
  configurator.add<ScanMatchingNode>("scan_matching");
  configurator.add<MappingNode>("mapping");
  configurator.add<ScanAssemblyNode>("scan_assembly");
  configurator.add<TerrainNode>("terrain");
  configurator.add<VolumeMapNode>("volume_map");
  configurator.add<PlanningNode>("planning");
  configurator.add<DrivingNode>("driving");
  configurator.add<GuardNode>("guard");
  configurator.add<ExplorationNode>("exploration");
  configurator.add<MissionNode>("mission");
  return std::move(configurator).nodes();
}

}  // namespace adit

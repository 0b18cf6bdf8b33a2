// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include <filesystem>
#include <string>

#include <gtest/gtest.h>

#include "common/bus/node/stages.hpp"
#include "common/config/config.hpp"
#include "procs/mapping/mapping_node.hpp"
#include "procs/scan_matching/scan_matching_node.hpp"
#include "sim/live/sim_config.hpp"

namespace adit {
namespace {

const std::filesystem::path kPath =
    std::filesystem::path(ADIT_SOURCE_DIR) / "deploy/config/groundhog.yaml";

template <class Section>
std::string yaml_of(const Section& section) {
  return to_yaml(section, Section::kSection);
}

template <class Params>
void expect_lasers_of_groundhog(const std::string& stage) {
  const auto params = load_section<Params>(load_config(kPath), stage);
  EXPECT_EQ(yaml_of(params.lasers), yaml_of(groundhog_lasers())) << stage;
}

TEST(GroundhogConfig, PutsTheLasersOfEveryStageWhereTheSimulatorHasThem) {
  expect_lasers_of_groundhog<ScanMatchingNode::Params>("scan_matching");
  expect_lasers_of_groundhog<MappingNode::Params>("mapping");
}

TEST(GroundhogConfig, IsWhatTheSimulatorIsWithoutIt) {
  const SimulationParams params = load_simulation_params(kPath, {});
  EXPECT_EQ(yaml_of(params.lasers), yaml_of(groundhog_lasers()));
  EXPECT_EQ(yaml_of(params.vehicle), yaml_of(Vehicle{}));
  EXPECT_EQ(to_yaml(params, kSimSection), to_yaml(SimulationParams{}, kSimSection));
}

TEST(GroundhogConfig, DiffersFromTheDefaultsOfStages) {  // else it would be of no use
  EXPECT_NE(yaml_of(ScanMatchingNode::Params{}.lasers), yaml_of(groundhog_lasers()));
}

}  // namespace
}  // namespace adit

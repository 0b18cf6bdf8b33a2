// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "sim/world/build_world.hpp"

#include <stdexcept>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace adit {
namespace {

using testing::HasSubstr;

WorldDescription tunnel() {
  WorldDescription description;
  description.name = "one tunnel";
  description.plan.tunnels = {{"main", {0.0, 0.0, 30.0, 0.0}, 3.0, false}};
  description.T_world_start = {5.0, 0.0, 0.5};
  return description;
}

std::string error_of(const WorldDescription& description) {
  try {
    build_world(description);
  } catch (const std::invalid_argument& error) {
    return error.what();
  }
  return "";
}

TEST(BuildWorld, KeepsNameAndStart) {
  const World world = build_world(tunnel());
  EXPECT_EQ(world.name, "one tunnel");
  EXPECT_EQ(world.T_world_start, (Pose2{5.0, 0.0, 0.5}));
}

TEST(BuildWorld, RejectsAnEmptyPlan) {
  EXPECT_THAT(error_of(WorldDescription{}), HasSubstr("neither a tunnel nor a room"));
}

TEST(BuildWorld, RejectsAStartInRockOrFarAway) {
  WorldDescription description = tunnel();
  description.T_world_start = {5.0, 2.0, 0.0};
  EXPECT_THAT(error_of(description),
              HasSubstr("x 5, y 2 is in rock; the nearest tunnel, 'main', is at x 5.0, y 0.0"));
  description.T_world_start = {5e6, 2e9, 0.0};
  EXPECT_THAT(error_of(description), HasSubstr("in rock"));
}

TEST(BuildWorld, RejectsInvalidRooms) {
  WorldDescription description = tunnel();
  description.plan.rooms = {{"r", {0.0, 0.0, 1.0, 1.0}}};
  EXPECT_THAT(error_of(description), HasSubstr("room 'r'"));
  description.plan.rooms.clear();
  description.plan.pillars = {{"q", {0.0, 0.0, 1.0}}};
  EXPECT_THAT(error_of(description), HasSubstr("pillar 'q'"));
}

TEST(BuildWorld, RejectsAPlanBeyondTheLimits) {
  WorldDescription description = tunnel();
  description.plan.tunnels[0].points_m = {0.0, 0.0, 1e9, 0.0};
  EXPECT_THAT(error_of(description), HasSubstr("from the origin"));
}

}  // namespace
}  // namespace adit

// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "sim/world/narrow_tunnel.hpp"

#include <cmath>
#include <numbers>
#include <stdexcept>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "sim/world/build_world.hpp"
#include "sim/world/world_file.hpp"

namespace adit {
namespace {

using testing::HasSubstr;

std::string error_of_narrow(const std::string& name) {
  try {
    find_world(name);
  } catch (const std::runtime_error& error) {
    return error.what();
  }
  return "";
}

TEST(NarrowTunnel, IsFoundByName) {
  EXPECT_EQ(find_world("narrow:1.5").name, "narrow_1.5");
  EXPECT_EQ(find_world("narrow:1.3,bent", 7).name, "narrow_1.3_bent");
  EXPECT_EQ(find_world("narrow:1.3,necked", 7).seed, 7);
}

TEST(NarrowTunnel, RejectsANameThatIsNotValid) {
  EXPECT_THAT(error_of_narrow("narrow:1.1"), HasSubstr("'1.1' is not a width"));
  EXPECT_THAT(error_of_narrow("narrow:1.5,round"), HasSubstr("'round' is neither straight"));
}

/// Width of the floor across the direction `heading_rad` at a point of the centre line, to 1 cm.
double width_at(const std::string& name, const Eigen::Vector2d& p_world, double heading_rad = 0.0) {
  const World world = build_world(find_world(name));
  const Eigen::Vector2d left(-std::sin(heading_rad), std::cos(heading_rad));
  double width_m = 0.0;
  for (const double side : {-1.0, 1.0}) {
    double offset_m = 0.0;
    while (world.truth.floor_height(p_world + side * offset_m * left)) offset_m += 0.01;
    width_m += offset_m;
  }
  return width_m;
}

constexpr double kReliefM = 0.05;  // of the walls: twice its height, its margin, and the 1 cm

TEST(NarrowTunnel, HasItsWidthWhereItIsNarrowest) {
  for (const char* name : {"narrow:1.3", "narrow:1.3,necked"}) {
    EXPECT_NEAR(width_at(name, {19.5, 0.0}), 1.3 + 0.02, kReliefM) << name;
  }
  // In the middle of a bend of 30° with a radius of 20 m that begins 2.26 m into the stretch.
  const double half_rad = std::numbers::pi / 12.0;
  const Eigen::Vector2d middle(14.26 + 20.0 * std::sin(half_rad),
                               20.0 * (1.0 - std::cos(half_rad)));
  EXPECT_NEAR(width_at("narrow:1.3,bent", middle, half_rad), 1.3 + 0.02, kReliefM);
}

TEST(NarrowTunnel, IsWiderElsewhere) {
  EXPECT_NEAR(width_at("narrow:1.3", {6.0, 0.0}), 3.0, kReliefM);
  EXPECT_NEAR(width_at("narrow:1.3", {32.0, 0.0}), 3.0, kReliefM);
  EXPECT_NEAR(width_at("narrow:1.3,necked", {15.0, 0.0}), 1.6 + 0.02, kReliefM);
}

}  // namespace
}  // namespace adit

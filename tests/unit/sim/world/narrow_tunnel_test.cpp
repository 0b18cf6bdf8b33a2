// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "sim/world/narrow_tunnel.hpp"

#include <cmath>
#include <numbers>
#include <stdexcept>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "sim/vehicle/stance.hpp"
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

/// The reason why the body, 0.05 m wider on each side than the vehicle, cannot follow the centre
/// line of the narrow stretch.
std::optional<std::string> stop_of(const std::string& name, double bend_rad) {
  Vehicle vehicle;
  vehicle.width_m += 0.1;
  const Site site(build_world(find_world(name)));
  Stance stance(site, vehicle);
  Pose2 pose{3.0, 0.0, 0.0};
  if (stance.put(pose, site.world().truth.floor_height({3.0, 0.0}).value())) return "start";
  constexpr double kStepM = 0.05;
  const double bend_m = 20.0 * std::abs(bend_rad);
  const double bend_from_m = 12.0 + (15.0 - bend_m) / 2.0 - 3.0;
  for (double s = 0.0; s < 28.0; s += kStepM) {
    const bool bends = s >= bend_from_m && s < bend_from_m + bend_m;
    pose = pose * Pose2{kStepM, 0.0, bends ? kStepM / 20.0 : 0.0};
    if (const auto stop = stance.move(pose)) return "at " + std::to_string(pose.x);
  }
  return std::nullopt;
}

TEST(NarrowTunnel, LetsAVehicleThroughThatIsTenCentimetresNarrower) {
  EXPECT_EQ(stop_of("narrow:1.31", 0.0), std::nullopt);
  EXPECT_EQ(stop_of("narrow:1.31,necked", 0.0), std::nullopt);
  EXPECT_EQ(stop_of("narrow:1.4,bent", std::numbers::pi / 6.0), std::nullopt);
}

TEST(NarrowTunnel, StopsAVehicleThatIsWider) {
  EXPECT_NE(stop_of("narrow:1.2", 0.0), std::nullopt);
  EXPECT_NE(stop_of("narrow:1.2,necked", 0.0), std::nullopt);
}

}  // namespace
}  // namespace adit

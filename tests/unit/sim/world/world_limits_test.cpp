// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
// World files with typing errors are rejected before they take minutes or all memory.
#include <fstream>
#include <stdexcept>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "sim/world/build_world.hpp"
#include "sim/world/world_file.hpp"
#include "tests/support/scratch_folder.hpp"

namespace adit {
namespace {

using testing::HasSubstr;
using testing::Not;

class WorldLimits : public testing::Test {
 protected:
  /// A world file with a tunnel along x and further keys of the section `world`, one per line.
  std::string error_of(const std::string& more, const std::string& tunnel_end = "40, 0") {
    const std::filesystem::path path = folder_ / "odd.yaml";
    std::ofstream(path) << "world:\n  T_world_start: {x_m: 5, y_m: 0, theta_rad: 0}\n"
                        << "  plan: {tunnels: [{name: main, points_m: [0, 0, " << tunnel_end
                        << "]}]}\n"
                        << more;
    try {
      build_world(find_world(path.string()));
    } catch (const std::exception& error) {
      EXPECT_THAT(error.what(), Not(HasSubstr("\n")));
      return error.what();
    }
    return "";
  }

  test::ScratchFolder folder_;
};

TEST_F(WorldLimits, ATunnelOfAMillionKilometresIsRejected) {
  EXPECT_THAT(error_of("", "1e9, 0"), HasSubstr("m is the most"));
  EXPECT_THAT(error_of("", "1e300, 1e300"), HasSubstr("m is the most"));
  EXPECT_THAT(error_of("", "1e-9, 0"), HasSubstr("same point twice"));
}

TEST_F(WorldLimits, AGridTooFineForTheMineIsRejected) {
  EXPECT_EQ(error_of("  grid_m: 0.2\n", "4900, 0"), "");
  EXPECT_THAT(error_of("  grid_m: 0.05\n", "4900, 490"), HasSubstr("too large for edges"));
  EXPECT_THAT(error_of("  grid_m: 0.001\n"), HasSubstr("grid_m"));
}

TEST_F(WorldLimits, WallsOfTooManyTrianglesAreRejected) {
  EXPECT_THAT(error_of("  grid_m: 0.05\n  heights: {clearance_m: 50}\n", "500, 0"),
              HasSubstr("too many"));
}

TEST_F(WorldLimits, ImplausibleNumbersAreRejectedByTheirKey) {
  const std::vector<std::pair<std::string, std::string>> worlds{
      {"props: {posts: [{tunnel: main, to_m: 30, every_m: 1e-9}]}", "every_m"},
      {"props: {rails: [{tunnel: main, to_m: 30, height_m: 1e9}]}", "height_m"},
      {"props: {rubble: [{tunnel: main, at_m: 9, radius_m: 1e9}]}", "radius_m"},
      {"props: {rubble: [{tunnel: main, at_m: 9, height_m: 1e9}]}", "height_m"},
      {"props: {cribs: [{tunnel: main, at_m: 9, across_m: 1e300}]}", "across_m"},
      {"heights: {clearance_m: 1e9}", "clearance_m"},
      {"heights: {profile_m: [0, 0, 9, 1e300]}", "profile_m"},
      {"heights: {floor_relief: {length_m: 1e-300}}", "length_m"},
      {"wall_relief: {height_m: 1e9}", "height_m"},
      {"mesh: {file: a.obj, flat_floor: true, floor_m: 1e30}", "floor_m"},
  };
  for (const auto& [text, key] : worlds) {
    EXPECT_THAT(error_of("  " + text + "\n"), HasSubstr(key)) << text;
  }
}

TEST_F(WorldLimits, APanelOfABillionEntriesIsRejected) {
  const std::filesystem::path path = folder_ / "panel.yaml";
  std::ofstream(path) << "world:\n  plan: {panels: [{name: p, entries: 2000000000}]}\n";
  EXPECT_THAT([&] { find_world(path.string()); },
              testing::ThrowsMessage<std::runtime_error>(HasSubstr("entries")));
}

}  // namespace
}  // namespace adit

// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include <stdexcept>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "tests/support/scratch_folder.hpp"
#include "tools/sim/sim_files.hpp"

namespace adit {
namespace {

using Json = nlohmann::json;

World sample_world() {
  World world;
  world.truth.tunnels.nodes = {{{0.0, 0.0}, true}, {{10.0, 0.0}, false}};
  world.truth.tunnels.edges = {{0, 1, {{0.0, 0.0}, {10.0, 0.0}}, 10.0, 3.0, "main"}};
  world.truth.plan = {{{{0.0, -1.5}, {10.0, -1.5}, {10.0, 1.5}, {0.0, 1.5}}}};
  world.truth.obstacles = {
      {PartKind::kPost, "posts_0", {{4.0, 1.0}, {4.2, 1.0}, {4.1, 1.2}}, 0.0, 2.0}};
  return world;
}

class TruthFiles : public testing::Test {
 protected:
  void SetUp() override { write_truth_files(sample_world(), folder_ / "truth"); }
  [[nodiscard]] Json read(const std::string& name) const {
    return Json::parse(test::contents(folder_ / ("truth/" + name)));
  }
  test::ScratchFolder folder_;
};

TEST_F(TruthFiles, HaveTheCentreLinesWithTheirLengths) {
  const Json features = read("tunnels.geojson")["features"];
  ASSERT_EQ(features.size(), 3U);
  EXPECT_EQ(features[0]["geometry"]["type"], "Point");
  EXPECT_EQ(features[0]["properties"]["entrance"], true);
  EXPECT_EQ(features[2]["geometry"]["type"], "LineString");
  EXPECT_EQ(features[2]["properties"]["length_m"], 10.0);
  EXPECT_EQ(features[2]["properties"]["to"], 1);
}

TEST_F(TruthFiles, HaveLevelsAndHeights) {
  World world = sample_world();
  world.truth.floor_height = [](const Eigen::Vector2d& p) { return 0.1 * p.x(); };
  world.truth.tunnels.edges[0].level = 2;
  world.truth.plan[0].level = 2;
  write_truth_files(world, folder_ / "truth");
  const Json features = read("tunnels.geojson")["features"];
  EXPECT_NEAR(features[1]["properties"]["floor_m"], 1.0, 1e-12);
  EXPECT_EQ(features[2]["properties"]["level"], 2);
  EXPECT_EQ(read("plan.geojson")["features"][0]["properties"]["level"], 2);
}

TEST_F(TruthFiles, HaveThePlanAsClosedRings) {
  const Json line = read("plan.geojson")["features"][0]["geometry"]["coordinates"];
  ASSERT_EQ(line.size(), 5U);
  EXPECT_EQ(line.front(), line.back());
}

TEST_F(TruthFiles, HaveTheObstacles) {
  const Json obstacle = read("obstacles.json")[0];
  EXPECT_EQ(obstacle["kind"], "post");
  EXPECT_EQ(obstacle["name"], "posts_0");
  EXPECT_EQ(obstacle["outline_m"].size(), 3U);
  EXPECT_EQ(obstacle["z_high_m"], 2.0);
}

TEST_F(TruthFiles, SayWhichOfThemAreEmpty) {
  EXPECT_TRUE(missing_truth(sample_world()).empty());
  World mesh = sample_world();
  mesh.truth.tunnels = {};
  ASSERT_EQ(missing_truth(mesh).size(), 1U);
  EXPECT_NE(missing_truth(mesh)[0].find("tunnels.geojson is empty"), std::string::npos);
  mesh.truth.plan.clear();
  EXPECT_EQ(missing_truth(mesh).size(), 2U);
}

TEST_F(TruthFiles, ReportAWriteError) {
  EXPECT_THROW(write_truth_files(sample_world(), "/proc/truth"), std::runtime_error);
}

}  // namespace
}  // namespace adit

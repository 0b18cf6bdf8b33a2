// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
// adit plan on simulated scans, compared with the stages.
#include "tools/plan/plan_run.hpp"

#include <fstream>
#include <sstream>

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "procs/terrain/terrain.hpp"
#include "tests/support/scratch_folder.hpp"
#include "tests/unit/tools/cloud/cloud_bytes.hpp"
#include "tests/unit/tools/plan/swept_scan.hpp"
#include "tools/cloud/cloud_file.hpp"
#include "tools/sim/sim_files.hpp"

namespace adit {
namespace {

using nlohmann::json;
using testing::HasSubstr;

const char* const kFiles[] = {"terrain.png", "clearance.png", "unknown.png", "c_space.png",
                              "kernels.png", "plan.png",      "sheet.png"};

PlannedPath path_of_stages(const Cloud& cloud) {
  PlanGoal goal;
  goal.T_odom_goal = cloud.T_odom_level;
  return Planning(PlanningParams{})
      .plan(Terrain(TerrainParams{}).make(cloud), goal, cloud.T_odom_level);
}

/// As in a point cloud file: one line, no beams without return.
Cloud without_lines(const Cloud& cloud, const Eigen::Vector3f& origin) {
  Cloud bare;
  bare.lines.resize(1);
  bare.lines[0].origin = origin;
  for (const CloudLine& line : cloud.lines) {
    bare.lines[0].points.insert(bare.lines[0].points.end(), line.points.begin(), line.points.end());
  }
  return bare;
}

void expect_same_path(const json& written, const PlannedPath& path) {
  ASSERT_EQ(written["points"].size(), path.points.size());
  ASSERT_FALSE(path.points.empty());
  for (std::size_t i = 0; i < path.points.size(); ++i) {
    EXPECT_DOUBLE_EQ(written["points"][i]["x_m"], path.points[i].T_odom_body.x);
    EXPECT_DOUBLE_EQ(written["points"][i]["y_m"], path.points[i].T_odom_body.y);
  }
  EXPECT_EQ(written["reason"], path.reason);
  EXPECT_DOUBLE_EQ(written["cost"], path.points.back().cost);
}

class PlanRun : public testing::Test {
 protected:
  /// With the placement of the scan, whose vehicle is at the origin.
  [[nodiscard]] PlanRunOptions options(const std::string& input) const {
    PlanRunOptions options;
    options.input = folder_ / input;
    options.folder = folder_ / "out";
    options.placement.p_file_laser = origin_.cast<double>();
    options.placement.p_plan_vehicle = Eigen::Vector2d::Zero();
    options.placement.ground_m = 0.0;
    return options;
  }
  bool run(const PlanRunOptions& options) {
    out_.str("");
    return run_plan(options, out_, err_);
  }
  [[nodiscard]] json path_json() const {
    return json::parse(test::contents(folder_ / "out/path.json"));
  }

  test::ScratchFolder folder_;
  Eigen::Vector3f origin_{1.0F, 0.0F, 0.625F};
  std::ostringstream out_;
  std::ostringstream err_;
};

TEST_F(PlanRun, FindsThePathOfTheStagesForAScanInALog) {
  const Cloud cloud = test::swept_tunnel(true);
  write_scan(cloud, folder_ / "scan.lcmlog");
  EXPECT_TRUE(run(options("scan.lcmlog")));
  const json written = path_json();
  expect_same_path(written, path_of_stages(cloud));
  EXPECT_EQ(written["outcome"], "found");
  EXPECT_EQ(written["scan"]["id"], 7);
  EXPECT_GT(written["length_m"], 7.0);
  EXPECT_GT(written["least_clearance_m"], 0.0);
  EXPECT_GT(written["times_ms"]["scan_to_path"], 0.0);
  EXPECT_THAT(out_.str(), HasSubstr("found: A path was found."));
  for (const char* name : kFiles) {
    EXPECT_THAT(test::contents(folder_ / "out" / name), testing::StartsWith("\x89PNG")) << name;
  }
}

TEST_F(PlanRun, FindsThePathOfTheStagesForAPointCloud) {
  const Cloud cloud = test::swept_tunnel(true);
  write_scan(cloud, folder_ / "scan.ply");
  EXPECT_TRUE(run(options("scan.ply")));
  expect_same_path(path_json(), path_of_stages(without_lines(cloud, origin_)));
}

TEST_F(PlanRun, GivesTheSameTerrainForEveryFileFormat) {
  const Cloud cloud = test::swept_tunnel(true);
  write_scan(cloud, folder_ / "scan.ply");
  test::Points points;
  std::string text;
  for (const CloudLine& line : cloud.lines) {
    for (const Eigen::Vector3f& p : line.points) {
      points.emplace_back(p.cast<double>());
      text += fmt::format("{:.9g} {:.9g} {:.9g}\n", double{p.x()}, double{p.y()}, double{p.z()});
    }
  }
  std::ofstream(folder_ / "scan.pcd", std::ios::binary)
      << test::pcd<float>("binary_compressed", 'F', points);
  std::ofstream(folder_ / "scan.xyz") << text;
  std::vector<std::string> terrains;
  for (const char* name : {"scan.ply", "scan.pcd", "scan.xyz"}) {
    run(options(name));
    terrains.push_back(test::contents(folder_ / "out/terrain.png") +
                       test::contents(folder_ / "out/clearance.png"));
  }
  EXPECT_EQ(terrains[0], terrains[1]);
  EXPECT_EQ(terrains[0], terrains[2]);
}

TEST_F(PlanRun, ReportsBlockingCellsWithoutAPath) {
  write_scan(test::swept_tunnel(false), folder_ / "scan.lcmlog");
  EXPECT_FALSE(run(options("scan.lcmlog")));
  const json written = path_json();
  EXPECT_NE(written["outcome"], "found");
  EXPECT_TRUE(written["points"].empty());
  EXPECT_TRUE(written["least_clearance_m"].is_null());
  EXPECT_FALSE(written["blocking"].empty());
  EXPECT_THAT(out_.str(), HasSubstr("No path: "));
}

TEST_F(PlanRun, GivesTheSamePicturesTwice) {
  write_scan(test::swept_tunnel(true), folder_ / "scan.lcmlog");
  const auto pictures = [&] {
    run(options("scan.lcmlog"));
    std::string all;
    for (const char* name : kFiles) all += test::contents(folder_ / "out" / name);
    return all;
  };
  EXPECT_EQ(pictures(), pictures());
}

TEST_F(PlanRun, PlansToAGoalPose) {
  write_scan(test::swept_tunnel(true), folder_ / "scan.lcmlog");
  PlanRunOptions to = options("scan.lcmlog");
  to.goal = {PlanGoal::Kind::kToPose, {5.0, 0.5, 0.0}, 0.0};
  EXPECT_TRUE(run(to));
  const json last = path_json()["points"].back();
  EXPECT_NEAR(last["x_m"], 5.0, 0.35);  // goal tolerance and half a cell
  EXPECT_NEAR(last["y_m"], 0.5, 0.35);
}

TEST_F(PlanRun, FindsNoPathForAVehicleAsHighAsTheTunnel) {
  write_scan(test::swept_tunnel(true), folder_ / "scan.lcmlog");
  std::ofstream(folder_ / "high.yaml") << "vehicle: {height_m: 1.95}\n";
  PlanRunOptions high = options("scan.lcmlog");
  high.config = folder_ / "high.yaml";
  EXPECT_FALSE(run(high));
  EXPECT_THAT(out_.str(), HasSubstr("No path: "));
}

TEST_F(PlanRun, WritesNothingOnFailure) {
  std::ofstream(folder_ / "bad.xyz") << "1 2\n";
  EXPECT_THROW(run(options("bad.xyz")), std::runtime_error);
  std::ofstream(folder_ / "bad.yaml") << "terain: {}\n";
  PlanRunOptions bad = options("bad.xyz");
  bad.config = folder_ / "bad.yaml";
  EXPECT_THROW(run(bad), std::runtime_error);
  EXPECT_FALSE(std::filesystem::exists(folder_ / "out"));
}

}  // namespace
}  // namespace adit

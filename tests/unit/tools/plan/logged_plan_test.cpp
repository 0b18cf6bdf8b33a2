// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
// adit plan --logged: the plan of a mission, made again.
#include "tools/plan/logged_plan.hpp"

#include <sstream>
#include <string>
#include <string_view>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "common/bus/channels.hpp"
#include "common/bus/log/event_source.hpp"
#include "common/bus/log/lcm_log.hpp"
#include "common/bus/typed_messages.hpp"
#include "common/messages/diagnostics.hpp"
#include "common/messages/mapping/cloud.hpp"
#include "common/messages/mapping/odometry.hpp"
#include "common/messages/mapping/terrain.hpp"
#include "common/messages/navigation.hpp"
#include "procs/terrain/terrain.hpp"
#include "tests/support/scratch_folder.hpp"
#include "tests/unit/tools/plan/swept_scan.hpp"
#include "tools/plan/plan_run.hpp"

namespace adit {
namespace {

using testing::HasSubstr;

constexpr std::int64_t kUtime = 1'600'000'000'000'000;

/// A mission in a free tunnel whose terrain map remembers an obstacle that its scan does not show.
class LoggedPlanOfAMission : public testing::Test {
 protected:
  LoggedPlanOfAMission() {
    cloud_.utime = kUtime;
    terrain_ = Terrain(TerrainParams{}).make(cloud_);
    terrain_.id = cloud_.id;
    for (std::size_t i = 0; i < terrain_.cells.size(); ++i) {
      const Eigen::Vector2i at = terrain_.cells.cell(i);
      const double x = terrain_.centre(at.x(), at.y()).x();
      if (x > 3.0 && x < 3.5) terrain_.cells[i].coefficient_m = 0.9F;
    }
    goal_.id = cloud_.id;
    goal_.utime = kUtime;
    goal_.kind = PlanGoal::Kind::kRoute;
    goal_.route_odom = {{0.0, 0.0}, {8.0, 0.0}};
  }

  template <class Message>
  void write(std::string_view channel, const Message& message) {
    log_.write({kUtime, channel, encode(message)});
  }
  void write_terrain() {
    for (const TerrainFragment& fragment : split(terrain_))
      write(channels::kTerrain, to_message(fragment));
  }
  void write_pose() {
    StampedPose pose;
    pose.utime = kUtime;
    write(channels::kPose, to_message(pose));
  }
  /// The answer of planning for a vehicle of this height.
  PlannedPath write_mission(double height_m, bool with_cloud = true) {
    PlanningParams params;
    params.vehicle.height_m = height_m;
    for (const CloudFragment& fragment : split(with_cloud ? cloud_ : Cloud{}))
      write(channels::kCloud, to_message(fragment));
    write_terrain();
    write_pose();
    write(channels::kConfig, to_message(ConfigSnapshot{kUtime, "planning", "1", to_yaml(params)}));
    write(channels::kGoal, to_message(goal_));
    PlannedPath path = Planning(params).plan(terrain_, goal_, {});
    write(channels::kPath, to_message(path));
    return path;
  }
  static std::string to_yaml(const PlanningParams& params) {
    return "vehicle: {height_m: " + std::to_string(params.vehicle.height_m) + "}\nplanning: {}\n";
  }
  bool run() {
    log_.close();
    PlanRunOptions options;
    options.input = file_;
    options.folder = folder_ / "out";
    options.choice.id = goal_.id;
    options.logged = true;
    return run_plan(options, out_, err_);
  }

  test::ScratchFolder folder_;
  std::filesystem::path file_ = folder_ / "run.lcmlog";
  LogWriter log_{file_};
  Cloud cloud_ = test::swept_tunnel(true);
  TerrainMap terrain_;
  PlanGoal goal_;
  std::ostringstream out_;
  std::ostringstream err_;
};

TEST_F(LoggedPlanOfAMission, RestsOnItsTerrainAndParameters) {
  const PlannedPath path = write_mission(0.8);
  ASSERT_NE(path.outcome, PlanOutcome::kFound);
  EXPECT_FALSE(run());
  const LoggedPlan logged = logged_plan(file_, goal_.id);
  EXPECT_EQ(logged.params.value().vehicle.height_m, 0.8);
  EXPECT_EQ(logged.path.value().reason, path.reason);
  EXPECT_EQ(logged.goal, goal_);
  EXPECT_THAT(out_.str(), HasSubstr(path.reason));
  EXPECT_THAT(out_.str(), HasSubstr("as in the mission"));
  const auto json = nlohmann::json::parse(test::contents(folder_ / "out/path.json"));
  EXPECT_EQ(json["goal"]["route"].size(), 2U);
  EXPECT_EQ(json["reason"], path.reason);
}

TEST_F(LoggedPlanOfAMission, NeedsNoScan) {
  write_mission(0.8, false);
  EXPECT_FALSE(run());
  EXPECT_TRUE(logged_plan(file_, goal_.id).cloud.lines.empty());
  EXPECT_THAT(out_.str(), HasSubstr("as in the mission"));
  EXPECT_EQ(err_.str(), "");
}

TEST_F(LoggedPlanOfAMission, SaysWhatTheMissionHadInstead) {
  write_mission(0.8);
  PlannedPath other;
  other.id = goal_.id;
  other.outcome = PlanOutcome::kSearchLimit;
  other.reason = "The search reached its maximum number of expansions.";
  log_.close();
  LogWriter again(folder_ / "again.lcmlog");
  LogReader events(file_);
  while (const auto event = events.next()) {
    if (event->channel != channels::kPath) again.write(*event);
  }
  again.write({kUtime, channels::kPath, encode(to_message(other))});
  again.close();
  file_ = folder_ / "again.lcmlog";
  EXPECT_FALSE(run());
  EXPECT_THAT(out_.str(), HasSubstr("in the mission: search_limit: " + other.reason));
}

TEST_F(LoggedPlanOfAMission, NamesWhatIsMissing) {
  const auto expect_error = [&](const std::string& text) {
    log_.close();
    EXPECT_THAT([&] { logged_plan(file_, goal_.id); },
                testing::ThrowsMessage<std::runtime_error>(HasSubstr(text)));
  };
  write_pose();
  write(channels::kGoal, to_message(goal_));
  expect_error("no complete terrain map before goal 7");
}

TEST_F(LoggedPlanOfAMission, IsNoneOfAnUnknownGoalOrARetracedPath) {
  write_mission(0.8);
  goal_.id = 9;
  goal_.kind = PlanGoal::Kind::kRetrace;
  goal_.traversed_path_odom = {{0.0, 0.0, 0.0}, {-1.0, 0.0, 0.0}};
  write(channels::kGoal, to_message(goal_));
  log_.close();
  EXPECT_THAT([&] { logged_plan(file_, 8); },
              testing::ThrowsMessage<std::runtime_error>(HasSubstr("no goal 8 on GOAL")));
  EXPECT_THAT([&] { logged_plan(file_, 9); },
              testing::ThrowsMessage<std::runtime_error>(HasSubstr("retraces")));
}

}  // namespace
}  // namespace adit

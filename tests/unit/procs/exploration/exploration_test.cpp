// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "procs/exploration/exploration.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>

#include <gtest/gtest.h>

#include "sim/world/random/random_mine.hpp"
#include "tests/support/robots/exploring_robot.hpp"
#include "tests/unit/procs/exploration/test_mines.hpp"

namespace adit {
namespace {

using Kind = ExplorationDecision::Kind;
constexpr double kPlenty = 2000.0;

/// A robot, and an exploration with its local maps.
class Explorer {
 public:
  explicit Explorer(const test::PlanarMine& mine, const ExplorationParams& params = {},
                    double distortion_m = 0.0)
      : exploration(params), robot(mine, distortion_m) {
    update_map();
  }

  void update_map() {
    maps.push_back(robot.last_map());
    EXPECT_TRUE(exploration.add(maps.back()));
    EXPECT_TRUE(exploration.update(robot.graph()));
  }
  const ExplorationDecision& decide(double remaining_m = kPlenty) {
    return exploration.decide({robot.utime(), robot.T_map_body(), remaining_m, 0.0});
  }
  /// Drives along the route of the last decision.
  void drive(double distance_m) {
    robot.drive(exploration.route(), distance_m);
    update_map();
  }
  [[nodiscard]] std::vector<Frontier> frontiers(FrontierState state) const {
    std::vector<Frontier> found;
    for (const Frontier& frontier : exploration.frontiers()) {
      if (frontier.state == state) found.push_back(frontier);
    }
    return found;
  }

  Exploration exploration;
  test::ExploringRobot robot;
  std::vector<LocalMap> maps;
};

TEST(Exploration, StaysWithoutAMap) {
  Exploration exploration{ExplorationParams{}};
  const ExplorationDecision decision = exploration.decide({1, {}, kPlenty, 0.0});
  EXPECT_EQ(decision.kind, Kind::kStay);
  EXPECT_EQ(decision.reason, "there is no map yet");
}

TEST(Exploration, StartsStraightAheadAndClosesTheExitBehindTheStart) {
  const auto mine = tunnel_mine(straight());
  Explorer explorer(mine);
  const ExplorationDecision decision = explorer.decide();
  EXPECT_EQ(decision.kind, Kind::kAlong);
  EXPECT_GT(decision.T_map_goal.x, 5.0);  // range of 8 m
  EXPECT_NEAR(decision.T_map_goal.theta, 0.0, 0.4);
  const auto open = explorer.frontiers(FrontierState::kOpen);
  ASSERT_EQ(open.size(), 1U);
  EXPECT_NEAR(open[0].width_m, 3.0, 0.7);  // rough walls, and the rim of the known space is an arc
  EXPECT_FALSE(explorer.frontiers(FrontierState::kOutsideMine).empty());
}

/// The robot starts in the middle of a tunnel of 60 m, closed at both ends.
test::PlanarMine closed_tunnel() {
  const auto line = [](const Eigen::Vector2d& a, const Eigen::Vector2d& b) {
    return test::Segment{a, b};
  };
  return test::planar_mine({line({-30, -1.5}, {30, -1.5}), line({30, -1.5}, {30, 1.5}),
                            line({30, 1.5}, {-30, 1.5}), line({-30, 1.5}, {-30, -1.5})},
                           Pose2{});
}

TEST(Exploration, ExploresWhatLiesBehindAStartInMidCorridor) {
  const auto mine = closed_tunnel();
  Explorer explorer(mine);
  explorer.decide();
  EXPECT_EQ(explorer.frontiers(FrontierState::kOpen).size(), 2U);
  EXPECT_TRUE(explorer.frontiers(FrontierState::kOutsideMine).empty());
  Exploration exploration{ExplorationParams{}};
  const auto run = test::run_exploration(mine, exploration, kPlenty);
  EXPECT_TRUE(run.complete);
  EXPECT_TRUE(run.returned);
  EXPECT_GT(run.distance_travelled_m, 4 * 20.0);  // to where 8 m suffice to see the end, and back
}

/// Between both ends of the tunnel nothing shows which is the exit: the operator knows.
TEST(Exploration, TakesWhatLiesBehindAStartAtThePortalForTheExit) {
  const auto mine = closed_tunnel();
  ExplorationParams params;
  params.starts_at_portal = true;
  Explorer explorer(mine, params);
  const ExplorationDecision decision = explorer.decide();
  EXPECT_EQ(explorer.frontiers(FrontierState::kOpen).size(), 1U);
  EXPECT_NEAR(decision.T_map_goal.theta, 0.0, 0.4);
  const auto outside = explorer.frontiers(FrontierState::kOutsideMine);
  ASSERT_FALSE(outside.empty());
  EXPECT_EQ(outside[0].evidence,
            "behind the start: the exit of the mine, as the robot starts at the portal");
}

/// The exit closes what lies outside, not the route back of a robot that has passed it.
TEST(Exploration, LeadsBackIntoTheMineFromBeyondTheExit) {
  const auto mine = tunnel_mine(straight());
  Explorer explorer(mine);
  explorer.decide();
  explorer.robot.drive({{0.0, 0.0}, {-5.0, 0.0}}, 5.0);  // the portal is at x = -3 m
  explorer.update_map();
  const ExplorationDecision decision = explorer.decide();
  EXPECT_GE(decision.frontier, 0) << decision.reason;
  ASSERT_FALSE(explorer.exploration.route().empty());
  EXPECT_GT(explorer.exploration.route().back().x(), 0.0);
  EXPECT_FALSE(explorer.frontiers(FrontierState::kOutsideMine).empty());
  EXPECT_EQ(explorer.frontiers(FrontierState::kOpen).size(), 1U);
  explorer.drive(12.0);
  EXPECT_GT(explorer.robot.T_map_body().x, 4.0);
  EXPECT_GE(explorer.decide().frontier, 0);
}

/// The walls of the tunnels have 3 m between them, those of a crossing 4.2 m; both are rough.
TEST(Exploration, ReportsTheWidthOfTheCorridorAtAFrontier) {
  constexpr double kWidthM = 3.0;
  const auto mine = tunnel_mine(rooms_and_pillars(), kWidthM);
  Explorer explorer(mine);
  for (int i = 0; i < 40; ++i) {
    if (explorer.decide().kind == Kind::kDone) break;
    explorer.drive(5.0);
    for (const Frontier& frontier : explorer.frontiers(FrontierState::kOpen)) {
      EXPECT_LT(frontier.width_m, 1.7 * kWidthM) << frontier.id << " at " << i;
      EXPECT_GT(frontier.width_m, 0.3 * kWidthM) << frontier.id << " at " << i;
    }
  }
}

TEST(Exploration, DetectsTheArmsOfAJunctionAsFrontiers) {
  const auto mine = tunnel_mine(junction());
  Explorer explorer(mine);
  for (int i = 0; i < 4; ++i) {  // 20 m, to the junction
    explorer.decide();
    explorer.drive(5.0);
  }
  const auto open = explorer.frontiers(FrontierState::kOpen);
  ASSERT_EQ(open.size(), 2U);
  EXPECT_LT(open[0].direction_map.y() * open[1].direction_map.y(), 0.0);
  EXPECT_LT(open[0].p_map.y() * open[1].p_map.y(), 0.0);
}

TEST(Exploration, ExploresEveryMineCompletelyAndReturnsHome) {
  for (const auto& tunnels : {straight(), junction(), crossroads(), ring(), rooms_and_pillars()}) {
    Exploration exploration{ExplorationParams{}};
    const auto mine = tunnel_mine(tunnels);
    const auto run = test::run_exploration(mine, exploration, kPlenty);
    EXPECT_TRUE(run.complete);
    EXPECT_TRUE(run.returned) << run.distance_from_start_m;
    EXPECT_EQ(run.missed_m, 0.0);
    EXPECT_EQ(run.falsely_blocked, 0);
    for (const Frontier& frontier : exploration.frontiers())
      EXPECT_FALSE(frontier.evidence.empty());
  }
}

TEST(Exploration, ReturnsHomeWithinTheBudget) {
  for (int seed = 1; seed <= 6; ++seed) {
    const auto mine = test::planar_mine(build_world(random_mine(seed, {.level = true})));
    for (const double budget_m : {60.0, 120.0, 200.0}) {
      Exploration exploration{ExplorationParams{}};
      const auto run = test::run_exploration(mine, exploration, budget_m);
      EXPECT_TRUE(run.returned) << seed << ", " << budget_m << ": " << run.distance_from_start_m;
      EXPECT_LE(run.distance_travelled_m, budget_m);
    }
  }
}

TEST(Exploration, ReportsWhyItIsIncomplete) {
  const auto mine = tunnel_mine(straight());
  Explorer explorer(mine);
  const ExplorationDecision decision = explorer.decide(30.0);
  EXPECT_EQ(decision.kind, Kind::kDone);  // it is still at home
  EXPECT_FALSE(decision.complete);
  ASSERT_EQ(explorer.frontiers(FrontierState::kBeyondBudget).size(), 1U);
  const auto reasons = explorer.exploration.incomplete_reasons();
  ASSERT_EQ(reasons.size(), 1U);
  EXPECT_NE(reasons[0].find("beyond the budget"), std::string::npos) << reasons[0];
  EXPECT_EQ(explorer.decide(kPlenty).kind, Kind::kAlong);  // with a larger budget it is open again
}

TEST(Exploration, RetainsTheIdentityOfAFrontierWhenTheGraphMoves) {
  const auto mine = tunnel_mine(crossroads());
  Explorer explorer(mine, {}, 0.3);
  for (int i = 0; i < 4; ++i) {
    explorer.decide();
    explorer.drive(5.0);
  }
  const auto before = explorer.frontiers(FrontierState::kOpen);
  MapGraph moved = explorer.robot.graph();
  const Pose2 T{7.0, -3.0, 0.4};
  for (Pose2& pose : moved.poses) pose = T * pose;
  EXPECT_TRUE(explorer.exploration.update(moved));
  const auto after = explorer.frontiers(FrontierState::kOpen);
  ASSERT_EQ(before.size(), 3U);
  ASSERT_EQ(after.size(), 3U);
  for (std::size_t i = 0; i < 3; ++i) {
    EXPECT_EQ(after[i].id, before[i].id);
    // Cells are rastered again, so that the centre of a frontier moves by a few of them.
    EXPECT_LT((after[i].p_map - T * before[i].p_map).norm(), 0.8);
  }
}

TEST(Exploration, FollowsAFrontierDownItsCorridor) {
  const auto mine = tunnel_mine(straight());
  Explorer explorer(mine);
  const int first = explorer.decide().frontier;
  for (int i = 0; i < 4; ++i) {
    explorer.drive(5.0);
    EXPECT_EQ(explorer.decide().frontier, first);
  }
}

TEST(Exploration, DoesNotChooseABlockedFrontierOrFrontiersBehindIt) {
  const auto mine = tunnel_mine(crossroads());
  Explorer explorer(mine);
  for (int i = 0; i < 4; ++i) {
    explorer.decide();
    explorer.drive(5.0);
  }
  const int blocked = explorer.decide().frontier;
  EXPECT_TRUE(
      explorer.exploration.report_blocked(blocked, {explorer.robot.utime(), 1.0, "a beam"}));
  for (int i = 0; i < 12; ++i) {
    EXPECT_NE(explorer.decide().frontier, blocked);
    explorer.drive(5.0);
  }
  const Frontier frontier = explorer.exploration.frontiers()[static_cast<std::size_t>(blocked)];
  EXPECT_EQ(frontier.state, FrontierState::kBlocked);
  EXPECT_EQ(frontier.evidence, "a beam");
  EXPECT_FALSE(explorer.exploration.report_blocked(999, {}));
}

/// The barrier across the tunnel ahead also crosses the mouth of the branch.
TEST(Exploration, RetriesABranchBehindTheBarrierOfAnotherFrontier) {
  const auto mine = tunnel_mine({{0, 0, 45, 0}, {25, 0, 33, -16}});
  Explorer explorer(mine);
  while (explorer.robot.T_map_body().x < 20.5) {  // from 3 m in world
    explorer.decide();
    explorer.drive(1.0);
  }
  ASSERT_EQ(explorer.frontiers(FrontierState::kOpen).size(), 2U);
  const int first = explorer.decide().frontier;
  const BlockedEvidence water{explorer.robot.utime(), 0.0, "water"};
  EXPECT_TRUE(explorer.exploration.report_blocked(first, water));
  ASSERT_EQ(explorer.frontiers(FrontierState::kBlocked).size(), 2U);
  const int other = explorer.decide().frontier;
  ASSERT_NE(other, ExplorationDecision::kNoFrontier);
  EXPECT_NE(other, first);
  EXPECT_EQ(explorer.frontiers(FrontierState::kBlocked).size(), 1U);
  EXPECT_TRUE(explorer.exploration.report_blocked(other, water));
  EXPECT_EQ(explorer.decide().kind, Kind::kHome);
  EXPECT_TRUE(explorer.exploration.incomplete_reasons().empty());
}

/// A robot that passed a barrier must return home through it.
TEST(Exploration, RemovesABarrierThatTheRobotHasPassed) {
  const auto mine = tunnel_mine(straight());
  Explorer explorer(mine);
  explorer.decide();
  explorer.drive(5.0);
  const int frontier = explorer.decide().frontier;
  const auto route = explorer.exploration.route();
  EXPECT_TRUE(
      explorer.exploration.report_blocked(frontier, {explorer.robot.utime(), 1.0, "a beam"}));
  ASSERT_EQ(explorer.decide().kind, Kind::kHome);
  explorer.robot.drive(route, 4.0);  // the barrier is 2 m from the start of the route
  explorer.update_map();
  EXPECT_NE(explorer.decide().kind, Kind::kStay);
  EXPECT_FALSE(explorer.exploration.route().empty());
}

TEST(Exploration, RetriesAnUnconfirmedFrontierOnceAndIsNeverComplete) {
  const auto mine = tunnel_mine(straight());
  Explorer explorer(mine);
  const int frontier = explorer.decide().frontier;
  const BlockedEvidence evidence{1, 1.0, "nothing was observed", true};
  EXPECT_TRUE(explorer.exploration.report_blocked(frontier, evidence));
  EXPECT_EQ(explorer.decide().frontier, frontier);
  EXPECT_TRUE(explorer.exploration.report_blocked(frontier, evidence));
  EXPECT_EQ(explorer.decide().kind, Kind::kDone);
  EXPECT_FALSE(explorer.decide().complete);
  EXPECT_EQ(explorer.frontiers(FrontierState::kUnconfirmed).size(), 1U);
  EXPECT_NE(explorer.decide().reason.find("nothing was observed"), std::string::npos);
  // A confirmed obstacle closes it.
  EXPECT_TRUE(explorer.exploration.reopen(frontier, 2));
  EXPECT_TRUE(explorer.exploration.report_blocked(frontier, {3, 1.0, "a beam"}));
  EXPECT_TRUE(explorer.decide().complete);
}

TEST(Exploration, RetriesAnUnobservableFrontierOnceAndIsNeverComplete) {
  const auto mine = tunnel_mine(straight());
  Explorer explorer(mine);
  const int frontier = explorer.decide().frontier;
  // Twice the number of stalls, and one of the retry that only sets the least distance.
  const int local_maps = 2 * ExplorationParams{}.frontiers.stalls + 1;
  for (int i = 0; i < local_maps; ++i) {
    EXPECT_EQ(explorer.decide().frontier, frontier) << i;
    explorer.drive(0.0);
  }
  EXPECT_EQ(explorer.decide().kind, Kind::kDone);
  EXPECT_EQ(explorer.frontiers(FrontierState::kUnobservable).size(), 1U);
  EXPECT_FALSE(explorer.decide().complete);
  EXPECT_NE(explorer.decide().reason.find("observed nothing behind it"), std::string::npos);
}

TEST(Exploration, VisitsOtherFrontiersBeforeUnconfirmedOnes) {
  const auto mine = tunnel_mine(crossroads());
  Explorer explorer(mine);
  for (int i = 0; i < 4; ++i) {
    explorer.decide();
    explorer.drive(5.0);
  }
  const int unconfirmed = explorer.decide().frontier;
  const BlockedEvidence evidence{explorer.robot.utime(), 1.0, "nothing was observed", true};
  EXPECT_TRUE(explorer.exploration.report_blocked(unconfirmed, evidence));
  const ExplorationDecision next = explorer.decide();
  EXPECT_NE(next.frontier, unconfirmed);
  EXPECT_NE(next.frontier, ExplorationDecision::kNoFrontier);
}

TEST(Exploration, VisitsABlockedFrontierThatTheOperatorReopens) {
  const auto mine = tunnel_mine(straight());
  Explorer explorer(mine);
  const int frontier = explorer.decide().frontier;
  EXPECT_TRUE(explorer.exploration.report_blocked(frontier, {1, 1.0, "a beam"}));
  EXPECT_EQ(explorer.decide().kind, Kind::kDone);
  EXPECT_TRUE(explorer.decide().complete);
  EXPECT_TRUE(explorer.exploration.reopen(frontier, 2));
  EXPECT_EQ(explorer.decide().frontier, frontier);
  EXPECT_FALSE(explorer.exploration.reopen(frontier, 2));  // it is not closed
}

TEST(Exploration, ReturnsFromTheEndOfTheCorridorInTheModeOfThePaper) {
  ExplorationParams params;
  params.mode = "corridor";
  Exploration exploration(params);
  const auto mine = tunnel_mine(crossroads());
  const auto run = test::run_exploration(mine, exploration, kPlenty);
  EXPECT_TRUE(run.returned);
  EXPECT_FALSE(run.complete);                 // the arms to both sides stay open
  EXPECT_GT(run.distance_travelled_m, 60.0);  // 42 m in, less the range ahead, and back
  EXPECT_LT(run.distance_travelled_m, 90.0);
}

TEST(Exploration, IsDeterministic) {
  const auto mine = tunnel_mine(rooms_and_pillars());
  std::vector<ExplorationReport> reports;
  for (int i = 0; i < 2; ++i) {
    Exploration exploration{ExplorationParams{}};
    test::run_exploration(mine, exploration, 300.0, 0.1);
    reports.push_back(exploration.report());
  }
  EXPECT_EQ(reports[0], reports[1]);
}

TEST(Exploration, DoesNotOscillateAtCrossings) {
  Exploration exploration{ExplorationParams{}};
  const auto mine = tunnel_mine(rooms_and_pillars());
  const auto run = test::run_exploration(mine, exploration, kPlenty, 0.1);
  EXPECT_TRUE(run.complete);
  EXPECT_LE(run.turns, 6);
  EXPECT_LT(run.distance_travelled_m, 2.0 * mine.corridor_m());
}

TEST(Exploration, RejectsMalformedLocalMaps) {
  const auto mine = tunnel_mine(straight());
  const test::ExploringRobot robot(mine);
  Exploration exploration{ExplorationParams{}};
  LocalMap map = robot.last_map();
  EXPECT_FALSE(exploration.add(LocalMap{}));
  map.id = -1;
  EXPECT_FALSE(exploration.add(map));
  map = robot.last_map();
  map.scans[0].T_local_body.x = std::numeric_limits<double>::quiet_NaN();
  EXPECT_FALSE(exploration.add(map));
  map.scans[0].T_local_body.x = 1e9;
  EXPECT_FALSE(exploration.add(map));
  map = robot.last_map();
  for (float& range : map.scans[0].scan.ranges_m) range = std::numeric_limits<float>::quiet_NaN();
  EXPECT_TRUE(exploration.add(map));  // with half of its scans
  MapGraph graph = robot.graph();
  graph.poses[0].theta = std::numeric_limits<double>::infinity();
  EXPECT_FALSE(exploration.update(graph));
}

/// A terrain map of 20 m by 6 m around a place in the tunnel straight(): ground within 1.4 m of its
/// axis and up to its end, rock elsewhere; observed up to this x in map.
constexpr double kEndM = 36.7;  // in map; the walls are rough
TerrainMap terrain_of_tunnel(const Pose2& T_map_level, double observed_to_m, double end_m = kEndM) {
  TerrainMap terrain;
  terrain.p_level_corner = {-10.0, -3.0};
  terrain.cell_m = 0.1;
  terrain.cells = Grid2<TerrainCell>(200, 60);
  for (std::size_t i = 0; i < terrain.cells.size(); ++i) {
    const Eigen::Vector2i at = terrain.cells.cell(i);
    const Eigen::Vector2d p_map = T_map_level * terrain.centre(at.x(), at.y());
    if (p_map.x() > observed_to_m) continue;
    TerrainCell& cell = terrain.cells[i];
    cell.ground = Ground::kObserved;
    cell.coefficient_m = p_map.x() > end_m || std::abs(p_map.y()) > 1.4 ? 1.0F : 0.02F;
    cell.clearance_m = 2.0F;
  }
  return terrain;
}
constexpr double kBeforeTheEndM = 35.0;
constexpr double kBeyondTheEndM = 100.0;

/// In a tunnel whose end it has seen by level lasers, from farther than ground that rises to them.
class DeadEnd : public testing::Test {
 protected:
  DeadEnd() {
    while (explorer_.robot.T_map_body().x < 34.0 && explorer_.decide().kind == Kind::kAlong) {
      explorer_.drive(1.0);
    }
  }
  void scan_3d(const Pose2& T_map_level, double observed_to_m) {
    const ScannedGround* added =
        explorer_.exploration.add(terrain_of_tunnel(T_map_level, observed_to_m), T_map_level);
    ASSERT_NE(added, nullptr);
    grounds_.push_back(*added);
  }

  test::PlanarMine mine_ = tunnel_mine(straight());
  Explorer explorer_{mine_};
  std::vector<ScannedGround> grounds_;
};

TEST_F(DeadEnd, IsExploredWithout3DScans) {
  EXPECT_NEAR(explorer_.robot.T_map_body().x, 30.0, 1.5);  // 8 m from the end
  EXPECT_TRUE(explorer_.decide().complete);
  EXPECT_FALSE(explorer_.exploration.memory().verify_walls);
}

TEST_F(DeadEnd, IsNotExploredUntilA3DScanShowsRock) {
  for (double x_m = 0.0; x_m < 30.0; x_m += 5.0) scan_3d({x_m, 0.0, 0.0}, kBeforeTheEndM);
  const ExplorationDecision decision = explorer_.decide();
  EXPECT_TRUE(explorer_.exploration.memory().verify_walls);
  EXPECT_FALSE(decision.complete);
  ASSERT_NE(decision.frontier, ExplorationDecision::kNoFrontier);
  const Frontier frontier =
      explorer_.exploration.frontiers()[static_cast<std::size_t>(decision.frontier)];
  EXPECT_GT(frontier.p_map.x(), 34.0);
  scan_3d(explorer_.robot.T_map_body(), kBeyondTheEndM);
  EXPECT_TRUE(explorer_.decide().complete);
  EXPECT_EQ(explorer_.decide().kind, Kind::kHome);
}

/// A mission that turned around at an obstacle does not call the mine complete either.
TEST_F(DeadEnd, IsNotExploredWhenTheMissionReturnsBefore) {
  for (double x_m = 0.0; x_m < 30.0; x_m += 5.0) scan_3d({x_m, 0.0, 0.0}, kBeforeTheEndM);
  const auto return_home = [&] {
    return explorer_.exploration.decide(
        {explorer_.robot.utime(), explorer_.robot.T_map_body(), kPlenty, 0.0, true});
  };
  EXPECT_EQ(return_home().kind, Kind::kHome);
  EXPECT_FALSE(return_home().complete);
  scan_3d(explorer_.robot.T_map_body(), kBeyondTheEndM);
  EXPECT_TRUE(return_home().complete);
}

/// The level lasers saw rising ground.
TEST_F(DeadEnd, IsReopenedByA3DScanThatShowsGround) {
  ASSERT_TRUE(explorer_.decide().complete);
  const Pose2 T_map_level = explorer_.robot.T_map_body();
  const TerrainMap terrain = terrain_of_tunnel(T_map_level, kBeyondTheEndM, kBeyondTheEndM);
  ASSERT_NE(explorer_.exploration.add(terrain, T_map_level), nullptr);
  const ExplorationDecision decision = explorer_.decide();
  EXPECT_EQ(decision.kind, Kind::kAlong);
  ASSERT_NE(decision.frontier, ExplorationDecision::kNoFrontier);
  EXPECT_GT(
      explorer_.exploration.frontiers()[static_cast<std::size_t>(decision.frontier)].p_map.x(),
      36.0);
  EXPECT_FALSE(explorer_.exploration.memory().verify_walls);
}

/// After a restart all is there again, and the decision is the same.
TEST_F(DeadEnd, IsNotExploredAfterARestartEither) {
  for (double x_m = 0.0; x_m < 30.0; x_m += 5.0) scan_3d({x_m, 0.0, 0.0}, kBeforeTheEndM);
  const ExplorationDecision decision = explorer_.decide();
  Exploration restarted{ExplorationParams{}};
  restarted.restore(explorer_.exploration.memory());
  restarted.restore(grounds_);
  for (const LocalMap& map : explorer_.maps) EXPECT_TRUE(restarted.add(map));
  EXPECT_TRUE(restarted.update(explorer_.robot.graph()));
  const auto again =
      restarted.decide({explorer_.robot.utime(), explorer_.robot.T_map_body(), kPlenty, 0.0});
  EXPECT_EQ(again, decision);
}

TEST(Exploration, VerifiesWallsOnlyOnceEveryFrontierIsClosed) {
  const auto mine = tunnel_mine(straight());
  Explorer explorer(mine);
  ASSERT_NE(explorer.exploration.add(terrain_of_tunnel({}, kBeforeTheEndM), {}), nullptr);
  EXPECT_EQ(explorer.decide().kind, Kind::kAlong);
  EXPECT_FALSE(explorer.exploration.memory().verify_walls);
}

TEST(Exploration, AnchorsA3DScanToALocalMap) {
  const auto mine = tunnel_mine(straight());
  Exploration empty{ExplorationParams{}};
  EXPECT_EQ(empty.add(terrain_of_tunnel({}, kBeforeTheEndM), {}), nullptr);  // no local map yet
  Explorer explorer(mine);
  for (int i = 0; i < 3; ++i) {
    explorer.decide();
    explorer.drive(5.0);
  }
  const Pose2 T_map_level{1.0, 0.1, 0.2};
  const ScannedGround* added =
      explorer.exploration.add(terrain_of_tunnel(T_map_level, kBeforeTheEndM), T_map_level);
  ASSERT_NE(added, nullptr);
  const auto local_map = static_cast<std::size_t>(added->local_map);
  const Pose2 T_map_local = explorer.robot.graph().poses.at(local_map);
  EXPECT_LT(between(T_map_level, T_map_local * added->T_local_level).vector().norm(), 1e-9);
  EXPECT_LT(T_map_local.x, 6.0);  // near it, not the newest
}

}  // namespace
}  // namespace adit

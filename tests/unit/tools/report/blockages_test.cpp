// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "tools/report/page/blockages.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tools/report/page/mission_summary.hpp"
#include "tools/report/page/seen_ground.hpp"

namespace adit {
namespace {

using testing::HasSubstr;
using testing::Not;

constexpr const char* kObstacle = "No path: blocked by an obstacle that is too high to drive over.";

Frontier frontier_at(double x_m, FrontierState state, const std::string& evidence,
                     double width_m = 2.5) {
  Frontier frontier;
  frontier.p_map = {x_m, 0.0};
  frontier.state = state;
  frontier.evidence = evidence;
  frontier.width_m = width_m;
  return frontier;
}

/// 36 m straight ahead, in steps of 0.5 m.
Trajectory drive() {
  Trajectory path;
  for (int i = 0; i <= 72; ++i) path.push_back({1 + i, {0.5 * i, 0.0, 0.0}, 0.0});
  return path;
}

MissionStatistics at_home() {
  MissionStatistics statistics;
  statistics.last.emplace();
  statistics.last->outcome = MissionOutcome::kHome;
  statistics.frontiers.emplace();
  statistics.explored_m = 38.0;
  return statistics;
}

TEST(Blockages, StateWhatWasSeenBeyondTheWaterAndWhatIsUnknown) {
  const auto found = blockages(
      {frontier_at(44.4, FrontierState::kBlocked,
                   std::string("No path: blocked by possible water. Again: ") + kObstacle)},
      drive(), nullptr);
  ASSERT_EQ(found.size(), 1U);
  EXPECT_NEAR(found[0].at_m, 35.0, 0.51);  // near it, a step
  EXPECT_NEAR(found[0].seen_beyond_m, 8.4, 1e-9);
  EXPECT_NEAR(found[0].frontier_m, 2.5, 1e-9);
  EXPECT_TRUE(found[0].is_proven);
  EXPECT_THAT(found[0].cause, HasSubstr("water"));
  const std::string text = headline(at_home(), found);
  EXPECT_THAT(text, HasSubstr("explored what it can reach, 38\u00A0m of tunnel"));
  EXPECT_THAT(text, HasSubstr("8\u00A0m seen beyond what blocks the tunnel"));
  EXPECT_THAT(text, HasSubstr("water at 3"));
  EXPECT_THAT(text, HasSubstr("2.5\u00A0m of frontier behind it unknown"));
}

TEST(Blockages, AreNotSaidToBlockWhatWasAbandonedWithoutEvidence) {
  const auto found =
      blockages({frontier_at(44.4, FrontierState::kUnconfirmed, kObstacle)}, drive(), nullptr);
  ASSERT_EQ(found.size(), 1U);
  EXPECT_FALSE(found[0].is_proven);
  MissionStatistics statistics = at_home();
  statistics.frontiers->open = 1;
  statistics.frontiers->unconfirmed = 1;
  const std::string text = headline(statistics, found);
  EXPECT_THAT(text, Not(HasSubstr("what it can reach")));
  EXPECT_THAT(text, HasSubstr("1 frontier abandoned without evidence of a blockage"));
  EXPECT_THAT(text, Not(HasSubstr("blocks the tunnel")));
}

/// A tunnel of 50 m, of which the robot drove 36; a beam saw each cell once.
TEST(Blockages, MeasureTheGroundThatWasSeenInTheMap) {
  OccupancyGrid grid{OccupancyGridParams{}};
  for (double x_m = -2.0; x_m <= 36.0; x_m += 0.5) {
    LaserScan scan;
    scan.ranges_m.assign(181, 0.0F);
    scan.angle_min_rad = -0.5 * std::numbers::pi;
    scan.angle_step_rad = std::numbers::pi / 180.0;
    for (std::size_t i = 0; i < scan.ranges_m.size(); ++i) {
      const double angle_rad = scan.angle_min_rad + static_cast<double>(i) * scan.angle_step_rad;
      const double to_wall_m = 1.5 / std::max(1e-9, std::abs(std::sin(angle_rad)));
      const double to_end_m = (50.0 - x_m) / std::max(1e-9, std::cos(angle_rad));
      scan.ranges_m[i] = static_cast<float>(std::min(to_wall_m, to_end_m));
    }
    ASSERT_TRUE(grid.insert(scan, {x_m, 0.0, 0.0}));
  }
  EXPECT_NEAR(SeenGround(grid, drive()).beyond_m({36.0, 0.0}), 14.0, 0.3);
  EXPECT_LT(SeenGround(grid, drive()).beyond_m({18.0, 0.0}), 4.3) << "the tunnel was driven";
  const auto found =
      blockages({frontier_at(44.4, FrontierState::kBlocked, kObstacle)}, drive(), &grid);
  EXPECT_NEAR(found.at(0).seen_beyond_m, 14.0, 0.3);
}

TEST(Blockages, JoinFrontiersBehindOnePlace) {
  const auto found =
      blockages({frontier_at(44.0, FrontierState::kUnconfirmed, "only level lasers show its end"),
                 frontier_at(40.0, FrontierState::kBlocked, kObstacle, 1.5),
                 frontier_at(10.5, FrontierState::kTooNarrow, "0.6 m")},
                drive(), nullptr);
  ASSERT_EQ(found.size(), 2U);
  EXPECT_NEAR(found[0].at_m, 9.5, 0.51);
  EXPECT_THAT(found[0].cause, HasSubstr("too narrow"));
  EXPECT_NEAR(found[1].seen_beyond_m, 8.0, 1e-9);
  EXPECT_NEAR(found[1].frontier_m, 4.0, 1e-9);
  EXPECT_THAT(found[1].cause, HasSubstr("too high")) << "what is proven decides";
}

TEST(Blockages, AreNoneWhereNothingEndsTheExploration) {
  EXPECT_TRUE(blockages({frontier_at(5.0, FrontierState::kExplored, ""),
                         frontier_at(-2.0, FrontierState::kOutsideMine, ""),
                         frontier_at(30.0, FrontierState::kOpen, "")},
                        drive(), nullptr)
                  .empty());
  EXPECT_TRUE(blockages({frontier_at(5.0, FrontierState::kBlocked, "")}, {}, nullptr).empty());
}

TEST(MissionHeadline, DoesNotClaimWhatWasNotReached) {
  MissionStatistics statistics = at_home();
  statistics.last->outcome = MissionOutcome::kStranded;
  statistics.distance_from_start_m = 12.2;
  statistics.frontiers->open = statistics.frontiers->visitable = 2;
  const std::string text = headline(statistics, {});
  EXPECT_THAT(text, HasSubstr("Stranded 12\u00A0m from the start"));
  EXPECT_THAT(text, HasSubstr("2 frontiers still to be visited"));
  EXPECT_THAT(text, Not(HasSubstr("can reach")));
}

}  // namespace
}  // namespace adit

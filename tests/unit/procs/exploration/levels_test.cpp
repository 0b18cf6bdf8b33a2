// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
// Levels above each other: a spiral ramp, in closed form.
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <numbers>
#include <optional>
#include <vector>

#include <gtest/gtest.h>

#include "procs/exploration/exploration.hpp"
#include "tests/support/worlds/wall_world.hpp"

namespace adit {
namespace {

constexpr double kRadiusM = 12.0;
constexpr double kHalfWidthM = 1.5;
constexpr double kGrade = 0.08;
constexpr double kTurnM = 2.0 * std::numbers::pi * kRadiusM;  // 75 m, which climb 6 m
constexpr double kBranchRad = 2.0;                            // on the first turn, to the right
constexpr double kExitFromRad = 2.0 * std::numbers::pi - 2.0;
constexpr double kExitToRad = 2.0 * std::numbers::pi - 0.2;
constexpr double kMapM = 5.0;
constexpr double kPlenty = 2000.0;

/// The ramp at a distance from its beginning: it turns left about (0, kRadiusM).
Pose2 on_ramp(double s_m) { return along_arc(s_m, s_m / kRadiusM); }

Eigen::Vector2d at_angle(double angle_rad, double radius_m) {
  return {radius_m * std::sin(angle_rad), kRadiusM - radius_m * std::cos(angle_rad)};
}

/// The walls of one turn in plan; the first one has a branch outwards.
test::WallWorld turn_of_ramp(bool is_first) {
  constexpr int kSteps = 120;
  constexpr double kStep = 2.0 * std::numbers::pi / kSteps;
  const double outer_m = kRadiusM + kHalfWidthM;
  std::vector<test::Segment> walls;
  for (int i = 0; i < kSteps; ++i) {
    const double from = i * kStep;
    const double middle = from + kStep / 2.0;
    const double inner_m = kRadiusM - kHalfWidthM;
    // Behind the start of the first turn is the exit: open air.
    if (is_first && middle > kExitFromRad && middle < kExitToRad) continue;
    walls.push_back({at_angle(from, inner_m), at_angle(from + kStep, inner_m)});
    if (is_first && std::abs(middle - kBranchRad) * outer_m < kHalfWidthM) continue;
    walls.push_back({at_angle(from, outer_m), at_angle(from + kStep, outer_m)});
  }
  if (!is_first) return test::WallWorld(walls);
  for (const double side : {-kHalfWidthM, kHalfWidthM}) {
    const double angle = kBranchRad + side / outer_m;
    const Eigen::Vector2d begin = at_angle(angle, outer_m);
    const Eigen::Vector2d outwards =
        at_angle(kBranchRad, outer_m + 20.0) - at_angle(kBranchRad, outer_m);
    walls.push_back({begin, begin + outwards});
  }
  return test::WallWorld(walls);
}

/// A robot that drives along the ramp, up or down.
class SpiralRamp {
 public:
  explicit SpiralRamp(double length_m, double grade = kGrade) : grade_(grade) {
    for (double s_m = 0.0; s_m + kMapM <= length_m + 1e-9; s_m += kMapM) add_map(s_m);
    length_m_ = kMapM * static_cast<double>(maps.size());
  }

  [[nodiscard]] MapGraph graph(bool with_heights = true) const {
    MapGraph graph;
    graph.utime = maps.back().end_utime;
    for (std::size_t i = 0; i < maps.size(); ++i) {
      const double s_m = kMapM * static_cast<double>(i);
      graph.poses.push_back(on_ramp(s_m));
      if (!with_heights) continue;
      graph.z_m.push_back(grade_ * s_m);
      graph.z_variance.push_back(std::pow(0.002 * s_m, 2));
    }
    return graph;
  }
  [[nodiscard]] Exploration exploration(bool with_heights = true) const {
    Exploration exploration{ExplorationParams{}};
    add_to(exploration, with_heights);
    return exploration;
  }
  void add_to(Exploration& exploration, bool with_heights = true) const {
    for (const LocalMap& map : maps) EXPECT_TRUE(exploration.add(map));
    EXPECT_TRUE(exploration.update(graph(with_heights)));
  }
  [[nodiscard]] ExplorationState state(bool returning_home, bool with_heights = true) const {
    ExplorationState state{maps.back().end_utime, on_ramp(length_m_), kPlenty, 0.0, returning_home};
    if (with_heights) state.z_m = grade_ * length_m_;
    return state;
  }
  [[nodiscard]] double length_m() const { return length_m_; }

  std::vector<LocalMap> maps;

 private:
  void add_map(double from_m) {
    constexpr double kScanEveryM = 1.25;
    LocalMap map;
    map.id = static_cast<int>(maps.size());
    map.T_odom_local = on_ramp(from_m);
    for (double s_m = from_m; s_m <= from_m + kMapM + 1e-9; s_m += kScanEveryM) {
      const auto utime = static_cast<std::int64_t>(1e9 + 1e6 * s_m);
      if (map.scans.empty()) map.utime = utime;
      map.end_utime = utime;
      const Pose2 T_local_body = between(on_ramp(from_m), on_ramp(s_m));
      const test::WallWorld& walls = s_m < 0.5 * kTurnM ? first_ : second_;
      const Lasers lasers;
      for (const auto& [channel, mount] :
           {std::pair("LASER_FRONT", lasers.front), std::pair("LASER_REAR", lasers.rear)}) {
        map.scans.push_back(
            {channel, test::exact_scan(walls, on_ramp(s_m) * mount.T_body_laser, utime, 30.0),
             T_local_body, grade_ * (s_m - from_m), Attitude{0.0, -std::atan(grade_)}});
      }
    }
    maps.push_back(map);
  }

  test::WallWorld first_ = turn_of_ramp(true);
  test::WallWorld second_ = turn_of_ramp(false);
  double grade_;
  double length_m_ = 0.0;
};

std::vector<Frontier> open_frontiers(const Exploration& exploration) {
  std::vector<Frontier> open = exploration.frontiers();
  std::erase_if(open, [](const Frontier& f) { return f.state != FrontierState::kOpen; });
  return open;
}

/// Angle by which a path turns about the axis of the ramp.
double turned_rad(const std::vector<Eigen::Vector2d>& path) {
  const Eigen::Vector2d axis(0.0, kRadiusM);
  double turned = 0.0;
  for (std::size_t i = 1; i < path.size(); ++i) {
    const Eigen::Vector2d a = path[i - 1] - axis;
    const Eigen::Vector2d b = path[i] - axis;
    turned += angle_diff(std::atan2(b.y(), b.x()), std::atan2(a.y(), a.x()));
  }
  return turned;
}

bool is_ahead(const Frontier& frontier, const SpiralRamp& ramp) {
  const Eigen::Vector2d p_body = on_ramp(ramp.length_m()).inverse() * frontier.p_map;
  return p_body.x() > 3.0 && p_body.norm() < 10.0;  // range of 8 m
}

bool is_at_branch(const Frontier& frontier) {
  return (frontier.p_map - at_angle(kBranchRad, kRadiusM + 6.0)).norm() < 4.0;
}

/// After one and a third turns, where a planar map would be closed all around.
TEST(Levels, FindsTheFrontiersOfBothLevels) {
  const SpiralRamp ramp(1.35 * kTurnM);
  const std::vector<Frontier> open = open_frontiers(ramp.exploration());
  EXPECT_EQ(std::ranges::count_if(open, is_at_branch), 1);
  // In front of the inner wall, which hides a part, there may be a second one.
  const auto ahead = std::ranges::count_if(open, [&](const auto& f) { return is_ahead(f, ramp); });
  EXPECT_GE(ahead, 1);
  EXPECT_EQ(static_cast<std::size_t>(ahead) + 1, open.size());
}

TEST(Levels, AreOneLevelWhereHeightsAreUnknown) {
  const SpiralRamp ramp(1.35 * kTurnM);
  Exploration exploration = ramp.exploration(false);
  for (const Frontier& frontier : open_frontiers(exploration))
    EXPECT_FALSE(is_ahead(frontier, ramp));
  const ExplorationDecision decision = exploration.decide(ramp.state(true, false));
  EXPECT_LT(decision.distance_m, 0.5 * kTurnM);  // through the roof
}

TEST(Levels, TheRouteHomeFollowsTheRamp) {
  for (const double turns : {1.35, 1.9, 2.6}) {
    const SpiralRamp ramp(turns * kTurnM);
    Exploration exploration = ramp.exploration();
    const ExplorationDecision decision = exploration.decide(ramp.state(true));
    EXPECT_EQ(decision.kind, ExplorationDecision::Kind::kHome);
    // Between the inner wall and the driven line, along the 8 directions of the grid.
    EXPECT_NEAR(decision.distance_m, ramp.length_m(), 0.1 * ramp.length_m());
    EXPECT_NEAR(turned_rad(exploration.route()), -ramp.length_m() / kRadiusM, 0.1);
    for (const Eigen::Vector2d& p : exploration.route())
      EXPECT_NEAR((p - Eigen::Vector2d(0.0, kRadiusM)).norm(), kRadiusM, kHalfWidthM);
  }
}

/// The robot stands above the start, and is not at home.
TEST(Levels, IsNotAtHomeAboveTheStart) {
  const SpiralRamp ramp(kMapM * std::round(kTurnM / kMapM));
  Exploration exploration = ramp.exploration();
  ExplorationState state = ramp.state(true);
  state.T_map_body = {};
  const ExplorationDecision decision = exploration.decide(state);
  EXPECT_EQ(decision.kind, ExplorationDecision::Kind::kHome);
  EXPECT_NEAR(decision.distance_m, kTurnM, 0.1 * kTurnM);
}

/// What blocks one level blocks nothing on the other.
TEST(Levels, ABarrierClosesOneLevelOnly) {
  const SpiralRamp ramp(1.2 * kTurnM);  // ahead it passes above the branch
  Exploration exploration = ramp.exploration();
  const ExplorationDecision ahead = exploration.decide(ramp.state(false));
  ASSERT_GE(ahead.frontier, 0);
  ASSERT_TRUE(is_ahead(exploration.frontiers()[static_cast<std::size_t>(ahead.frontier)], ramp));
  ASSERT_TRUE(exploration.report_blocked(ahead.frontier, {1, 3.0, "A wall.", false}));
  const ExplorationDecision branch = exploration.decide(ramp.state(false));
  ASSERT_GE(branch.frontier, 0);
  EXPECT_TRUE(is_at_branch(exploration.frontiers()[static_cast<std::size_t>(branch.frontier)]));
  const double along_m = ramp.length_m() - kBranchRad * kRadiusM;
  EXPECT_NEAR(branch.distance_m, along_m + 7.0, 0.15 * along_m);
}

/// Whether the budget allows the branch, from 78 m farther along the ramp.
bool is_branch_within_budget(double grade, double remaining_m) {
  const SpiralRamp ramp(1.35 * kTurnM, grade);
  ExplorationState state = ramp.state(false);
  state.remaining_m = remaining_m;
  Exploration exploration = ramp.exploration();
  exploration.decide(state);
  return std::ranges::count_if(open_frontiers(exploration), is_at_branch) == 1;
}

/// On a ramp that leads up, the path to the branch and the path home lead down and cost no climb;
/// on one that leads down, they climb 6 m and 2 m, of which the latter counts 1.5 times.
TEST(Levels, TheBudgetCountsTheClimb) {
  const double along_m = kMapM * std::floor(1.35 * kTurnM / kMapM) - kBranchRad * kRadiusM;
  const double level_m =  // 10 m beyond the branch, and a reserve of 20 m
      along_m + 7.0 + 10.0 + 1.5 * (kBranchRad * kRadiusM + 7.0 + 10.0) + 20.0;
  const double climb_m = FrontierChoiceParams{}.climb_factor *
                         (kGrade * along_m + 1.5 * kGrade * kBranchRad * kRadiusM);
  constexpr double kPathsM = 15.0;  // by which paths on the grid may differ from this
  EXPECT_TRUE(is_branch_within_budget(kGrade, level_m + kPathsM));
  EXPECT_FALSE(is_branch_within_budget(-kGrade, level_m + kPathsM));
  EXPECT_TRUE(is_branch_within_budget(-kGrade, level_m + climb_m + kPathsM));
}

TEST(Levels, AreTheSameAfterARestart) {
  const SpiralRamp ramp(1.9 * kTurnM);
  Exploration exploration = ramp.exploration();
  const ExplorationDecision decision = exploration.decide(ramp.state(false));
  Exploration restarted{ExplorationParams{}};
  restarted.restore(exploration.memory());
  ramp.add_to(restarted);
  EXPECT_EQ(restarted.decide(ramp.state(false)), decision);
  EXPECT_EQ(restarted.frontiers(), exploration.frontiers());
}

}  // namespace
}  // namespace adit

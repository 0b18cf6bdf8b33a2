// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "procs/mapping/joining/run_alignment.hpp"

#include <gtest/gtest.h>

namespace adit {
namespace {

const Pose2 kT_map_run{30.0, -12.0, 1.1};

/// Local maps every 10 m along a bent path, in the frame of the run.
std::vector<Pose2> run_poses() {
  std::vector<Pose2> poses;
  for (int i = 0; i < 8; ++i) poses.push_back({10.0 * i, 0.5 * i * i, 0.1 * i});
  return poses;
}

/// The same places in the map, seen with the opposite heading.
std::vector<Pose2> map_poses() {
  std::vector<Pose2> poses;
  for (const Pose2& pose : run_poses()) poses.push_back(kT_map_run * pose * Pose2{0.0, 0.0, 3.0});
  return poses;
}

/// A link of two local maps as if the run lay at `T_map_run`.
RunLink link(int older, int newer, const Pose2& T_map_run, double log_likelihood = 20.0) {
  const auto at = [](int i) { return static_cast<std::size_t>(i); };
  return {older,
          newer,
          between(map_poses()[at(older)], T_map_run * run_poses()[at(newer)]),
          log_likelihood,
          {1.0, 0.0}};
}

TEST(RunAlignment, FindsTheAlignmentOfTheLinksThatAgreeAmongWrongOnes) {
  std::vector<RunLink> links;
  for (int i = 0; i < 5; ++i) links.push_back(link(i, i, kT_map_run));
  for (int i = 0; i < 6; ++i)  // each elsewhere, and more likely
    links.push_back(link(7 - i, i, {-40.0 * i, 25.0 * i, 0.9 * i}, 60.0));
  const auto found = align_run(links, map_poses(), run_poses(), {});
  ASSERT_EQ(found.size(), 1U);  // the others agree with none
  EXPECT_EQ(found.front().places, 5);
  EXPECT_EQ(found.front().agreeing, (std::vector<std::size_t>{0, 1, 2, 3, 4}));
  EXPECT_LT(between(found.front().T_map_run, kT_map_run).translation().norm(), 1e-6);
}

TEST(RunAlignment, CountsLinksByTheSameWallsOnce) {
  std::vector<RunLink> links;
  for (int i = 0; i < 5; ++i) {
    links.push_back(link(i, i, kT_map_run));
    const Pose2 T_run_local = run_poses()[static_cast<std::size_t>(i)];
    links.back().p_newer_evidence = T_run_local.inverse() * Eigen::Vector2d(60.0, 3.0);
  }
  const auto found = align_run(links, map_poses(), run_poses(), {});
  ASSERT_EQ(found.size(), 1U);
  EXPECT_EQ(found.front().agreeing.size(), 5U);
  EXPECT_EQ(found.front().places, 1);
}

TEST(RunAlignment, SeesThatARunFitsAtTwoPlaces) {
  const Pose2 elsewhere = kT_map_run * Pose2{0.0, 20.0, 0.0};
  std::vector<RunLink> links;
  for (int i = 0; i < 5; ++i) links.push_back(link(i, i, kT_map_run));
  for (int i = 0; i < 4; ++i) links.push_back(link(i, i, elsewhere));
  const auto found = align_run(links, map_poses(), run_poses(), {});
  ASSERT_EQ(found.size(), 2U);
  EXPECT_EQ(found[0].places, 5);
  EXPECT_EQ(found[1].places, 4);
  EXPECT_LT(between(found[1].T_map_run, elsewhere).translation().norm(), 1e-6);
}

TEST(RunAlignment, ToleratesTheDriftOfBothMaps) {
  std::vector<RunLink> links;
  for (int i = 0; i < 7; ++i) {  // 1 % of the distance, which is 60 m at the end
    links.push_back(link(i, i, kT_map_run * Pose2{0.1 * i, 0.0, 0.002 * i}));
  }
  EXPECT_EQ(align_run(links, map_poses(), run_poses(), {}).front().places, 7);
}

TEST(RunAlignment, HasNoPlaceWithoutLinks) {
  EXPECT_TRUE(align_run({}, map_poses(), run_poses(), {}).empty());
}

}  // namespace
}  // namespace adit

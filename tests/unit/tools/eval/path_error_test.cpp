// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "tools/eval/path_error.hpp"

#include <cmath>

#include <gtest/gtest.h>

namespace adit {
namespace {

const Trajectory kPath{{1'000'000, {0, 0, 0}},
                       {2'000'000, {3, 0, 0.1}},
                       {3'000'000, {4, 1, 1.5}},
                       {4'000'000, {4, 5, 1.6}}};

Trajectory moved(const Pose2& T_to_from, Trajectory trajectory) {
  for (TimedPose& at : trajectory) at.pose = T_to_from * at.pose;
  return trajectory;
}

TEST(PathError, DoesNotDependOnTheFrame) {
  const Pose2 motion{10.0, -20.0, 2.5};
  const auto found = align(kPath, moved(motion, kPath));
  ASSERT_TRUE(found);
  EXPECT_NEAR(between(motion, *found).vector().norm(), 0.0, 1e-12);
  const PathError error = path_error(kPath, moved(motion, kPath));
  EXPECT_EQ(error.poses, 4U);
  EXPECT_NEAR(error.rmse_m + error.farthest_m + error.step_m, 0.0, 1e-12);
}

TEST(PathError, AlignsByAllPositions) {
  // Corners of a square, two of them moved away from the centre: alignment does not help.
  const Trajectory reference{{1'000'000, {1, 0, 0}},
                             {2'000'000, {0, 1, 0}},
                             {3'000'000, {-1, 0, 0}},
                             {4'000'000, {0, -1, 0}}};
  Trajectory found = reference;
  found[0].pose.x += 0.2;
  found[2].pose.x -= 0.2;
  const PathError error = path_error(found, reference);
  EXPECT_NEAR(error.rmse_m, 0.2 / std::sqrt(2.0), 1e-12);
  EXPECT_NEAR(error.farthest_m, 0.2, 1e-12);
  EXPECT_NEAR(error.step_m, 0.2, 1e-12);
}

TEST(PathError, UsesOnlyTimesThatTheReferenceCovers) {
  Trajectory longer = kPath;
  longer.push_back({9'000'000, {100, 100, 0}});
  EXPECT_EQ(path_error(longer, kPath).poses, 4U);
  EXPECT_NEAR(path_error(longer, kPath).rmse_m, 0.0, 1e-12);
  EXPECT_FALSE(align({{9'000'000, {}}}, kPath));
  EXPECT_EQ(path_error({}, kPath).poses, 0U);
}

TEST(PathError, FindsTheLongestStep) {
  EXPECT_DOUBLE_EQ(longest_step_m(kPath), 4.0);
  EXPECT_DOUBLE_EQ(longest_step_m({}), 0.0);
}

}  // namespace
}  // namespace adit

// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "common/records/hazard.hpp"

#include <gtest/gtest.h>

namespace adit {
namespace {

using Reason = BlockingCell::Reason;

/// A path blocked by a row of cells across it.
PlannedPath blocked_by(Reason reason, int cells, double height_m) {
  PlannedPath path;
  path.id = 3;
  for (int i = 0; i < cells; ++i) path.blocking.push_back({{4.0, 0.1 * i}, reason, height_m});
  return path;
}

TEST(Hazards, OfAPathAreItsStepsAndSlopes) {
  const std::vector<Hazard> steps = hazards_of(blocked_by(Reason::kStep, 1, 0.4), 0.3, Vehicle{});
  ASSERT_EQ(steps.size(), 1U);
  EXPECT_EQ(steps[0].kind, "step");
  EXPECT_EQ(steps[0].value, 0.4);
  EXPECT_EQ(steps[0].T_odom_centre.z_m, 0.3);
  EXPECT_EQ(hazards_of(blocked_by(Reason::kSlope, 1, 0.4), 0.0, Vehicle{}).size(), 1U);
}

TEST(Hazards, OfAPathAreNotWhatWasNotSeen) {
  for (const Reason reason : {Reason::kUnknown, Reason::kDrop, Reason::kWater})
    EXPECT_TRUE(hazards_of(blocked_by(reason, 20, 0.4), 0.0, Vehicle{}).empty());
}

TEST(Hazards, OfAPathAreLowRoofsWiderThanARib) {
  EXPECT_EQ(hazards_of(blocked_by(Reason::kRoof, 20, 0.9), 0.0, Vehicle{}).size(), 20U);
  EXPECT_TRUE(hazards_of(blocked_by(Reason::kRoof, 2, 0.9), 0.0, Vehicle{}).empty());
  EXPECT_TRUE(hazards_of(blocked_by(Reason::kRoof, 20, 0.1), 0.0, Vehicle{}).empty())
      << "below the belly it is an obstacle";
}

TEST(Hazards, JoinOnlyWithThoseOfTheirKindThatTouch) {
  Hazard pool;
  pool.kind = "water";
  pool.value = 2.0;
  pool.size_m = {2.0, 1.0};
  Hazard other = pool;
  other.value = 3.0;
  EXPECT_FALSE(join(pool, other, LevelPose{{3.5, 0.0, 0.0}, 0.0}));
  const auto shift = join(pool, other, LevelPose{{2.0, 0.0, 0.0}, 0.0});
  ASSERT_TRUE(shift);
  EXPECT_NEAR(shift->plan.x, 1.0, 1e-12);
  EXPECT_NEAR(pool.size_m.x(), 4.0, 1e-12);
  EXPECT_EQ(pool.value, 3.0);
  other.kind = "mud";
  EXPECT_FALSE(join(pool, other, LevelPose{}));
}

}  // namespace
}  // namespace adit

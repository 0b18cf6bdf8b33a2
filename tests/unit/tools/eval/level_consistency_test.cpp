// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "tools/eval/level_consistency.hpp"

#include <gtest/gtest.h>

namespace adit {
namespace {

constexpr std::int64_t kUtime = 1'000'000;

/// 10 m along x, back, and along x again, on the second pass `z_m` above the first: a pose per
/// 0.25 m, a local map per 5 m.
Trajectory twice_along(double z_m) {
  Trajectory path;
  for (int i = 0; i <= 120; ++i) {
    const double s_m = 0.25 * i;
    const double x = s_m <= 10.0 ? s_m : s_m <= 20.0 ? 20.0 - s_m : s_m - 20.0;
    const double rise = s_m <= 10.0 ? 0.0 : s_m <= 20.0 ? (s_m - 10.0) / 10.0 : 1.0;
    path.push_back({kUtime + i, {x, s_m > 10.0 && s_m <= 20.0 ? 4.0 : 0.0, 0.0}, rise * z_m});
  }
  return path;
}

std::map<int, std::int64_t> local_maps() {
  std::map<int, std::int64_t> utimes;
  for (int id = 0; id < 6; ++id) utimes[id] = kUtime + 20 * id;
  return utimes;
}

TEST(LevelConsistency, CountsLoopClosuresBetweenLevels) {
  const std::set<std::array<int, 2>> loop_closures{{0, 4}, {1, 5}};
  const Trajectory above = twice_along(5.0);
  EXPECT_EQ(score_levels(loop_closures, local_maps(), above, above).between_levels, 2U);
  const Trajectory same = twice_along(0.0);
  const LevelConsistency consistent = score_levels(loop_closures, local_maps(), same, same);
  EXPECT_EQ(consistent.between_levels, 0U);
  EXPECT_EQ(consistent.loop_closures, 2U);
}

TEST(LevelConsistency, MeasuresThePathThatIsMergedWithAnother) {
  const Trajectory above = twice_along(5.0);
  EXPECT_EQ(score_levels({}, local_maps(), above, above).merged_m, 0.0);
  // The map has all on one level: 10 m of the second pass.
  EXPECT_NEAR(score_levels({}, local_maps(), twice_along(0.0), above).merged_m, 10.0, 0.6);
}

}  // namespace
}  // namespace adit

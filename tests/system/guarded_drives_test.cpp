// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
// A simulated robot scans, plans and drives in tunnels with posts and rockfall, with a guard: all
// nodes from the laser to the wheels on one bus. A subset of guarded_drives_table in tests/eval.
#include "tests/support/drives/guarded_drives.hpp"

#include <gtest/gtest.h>

#include "tests/support/drives/path_drive.hpp"

namespace adit {
namespace {

class GuardedDrives : public testing::TestWithParam<int> {};

TEST_P(GuardedDrives, ArriveWithoutCollision) {
  const auto drives = drive_guarded(random_tunnel(GetParam()), 2);
  ASSERT_EQ(drives.size(), 2U);
  for (const GuardedDrive& drive : drives) {
    ASSERT_EQ(drive.outcome, PlanOutcome::kFound) << drive.reason;
    EXPECT_EQ(drive.failure, "");
    EXPECT_TRUE(drive.arrived()) << drive.state.reason;
    EXPECT_TRUE(drive.guard_stops.empty()) << drive.guard_stops.front().reason;
    EXPECT_GT(drive.path_m, 5.0);
    EXPECT_LE(absolute_quantile(drive.cross_track_error_m, 0.95), 0.10);
  }
}

INSTANTIATE_TEST_SUITE_P(Mines, GuardedDrives, testing::Values(2, 4));

}  // namespace
}  // namespace adit

// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
// Missions in which the clock of a sensor fails. More cases: clock_faults_table.
#include <cstddef>
#include <string>

#include <gtest/gtest.h>

#include "tests/support/clocks/clock_fault_mission.hpp"
#include "tests/support/scratch_folder.hpp"

namespace adit {
namespace {

using Kind = test::ClockFault::Kind;
using test::ClockFault;

test::ClockFaultResult result_of(const ClockFault& fault) {
  const test::ScratchFolder folder;
  return test::run_clock_fault({.number = 0, .mine = 3, .fault = fault}, folder.path());
}

void expect_home(const test::ClockFaultResult& result) {
  EXPECT_EQ(result.failure, "");
  EXPECT_EQ(result.outcome, MissionOutcome::kHome) << result.reason;
  EXPECT_FALSE(result.is_failure()) << result.distance_from_start_m << " m from the start";
  EXPECT_GT(result.changed, 0);
}

/// It cost 0.6 s of POSE when it was accepted.
TEST(ClockFaults, CostNoPoseForOneStampAhead) {
  const auto result = result_of({Kind::kJump, {"LASER_FRONT"}, 0.6, 15.2, 0.0});
  expect_home(result);
  ASSERT_TRUE(result.blind_after_s);
  EXPECT_LT(*result.blind_after_s, 0.1);
}

/// Accepted, it put the robot 0.56 m from where it said that it was.
TEST(ClockFaults, LeaveNoFalsePoseForAnImuThatIsAheadForGood) {
  const auto result = result_of({Kind::kJump, {"IMU"}, 1.0, 39.8, ClockFault::kForGood});
  expect_home(result);
  EXPECT_NE(result.reported.find("IMU is 1.0 s ahead"), std::string::npos) << result.reported;
}

TEST(ClockFaults, AreReportedOfAClockThatStandsStill) {
  const auto result = result_of({Kind::kFrozen, {"LASER_REAR"}, 0.0, 20.0, 15.0});
  expect_home(result);
  EXPECT_NE(result.reported.find("LASER_REAR stands still"), std::string::npos) << result.reported;
}

TEST(ClockFaults, HappenInEachCaseOnceAndInTheSameOrder) {
  const auto cases = test::clock_fault_cases(1);
  const auto again = test::clock_fault_cases(1);
  ASSERT_EQ(cases.size(), again.size());
  EXPECT_GE(cases.size(), 300U);
  for (std::size_t i = 0; i < cases.size(); ++i) {
    EXPECT_EQ(cases[i].fault.text(), again[i].fault.text());
    EXPECT_EQ(cases[i].fault.at_s, again[i].fault.at_s);
  }
}

}  // namespace
}  // namespace adit

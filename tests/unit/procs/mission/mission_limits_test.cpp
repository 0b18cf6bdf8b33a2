// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "procs/mission/mission_limits.hpp"

#include <gtest/gtest.h>

namespace adit {
namespace {

MissionLimitsParams unlimited() {
  MissionLimitsParams params;
  params.path_length_max_m = 1e5;
  params.time_max_s = 1e7;
  return params;
}

VehicleState charged(double share) {
  VehicleState state;
  state.battery_share = share;
  return state;
}

TEST(MissionLimits, LeavePathLengthThatWasNotTravelled) {
  MissionLimitsParams params = unlimited();
  params.path_length_max_m = 800.0;
  const MissionLimits limits(params);
  EXPECT_DOUBLE_EQ(limits.remaining_m(1000.0, 300.0), 500.0);
  EXPECT_DOUBLE_EQ(limits.remaining_m(1000.0, 900.0), 0.0);
}

TEST(MissionLimits, TurnAroundWhenTheDiskFails) {
  MissionLimits limits(unlimited());
  limits.add_disk_failure("");
  EXPECT_FALSE(limits.reason());
  limits.add_disk_failure("120 MB free");
  limits.add_disk_failure("cannot write");
  EXPECT_EQ(limits.reason(), "120 MB free");
}

TEST(MissionLimits, LeaveTheRemainingTimeAtTheMeanSpeed) {
  MissionLimitsParams params = unlimited();
  params.time_max_s = 1000.0;
  const MissionLimits limits(params);
  EXPECT_DOUBLE_EQ(limits.remaining_m(600.0, 120.0), 400.0 * 0.2);
  EXPECT_DOUBLE_EQ(limits.remaining_m(600.0, 3.0), 400.0 * 0.05);  // at least the minimum speed
  EXPECT_DOUBLE_EQ(limits.remaining_m(0.0, 0.0), 1000.0 * 0.05);
  EXPECT_DOUBLE_EQ(limits.remaining_m(1200.0, 120.0), 0.0);
}

TEST(MissionLimits, LeaveTheChargeAboveTheReserve) {
  MissionLimits limits(unlimited());  // 0.2 in reserve, 0.0002 per metre until measured
  limits.add(charged(0.9));
  EXPECT_NEAR(limits.remaining_m(0.0, 0.0), 0.7 / 0.0002, 1e-6);
  limits.add(charged(0.8));  // 0.1 for 200 m
  EXPECT_NEAR(limits.remaining_m(1.0, 200.0), 0.6 / (0.1 / 200.0), 1e-6);
  limits.add(charged(0.1));
  EXPECT_DOUBLE_EQ(limits.remaining_m(1.0, 300.0), 0.0);
}

TEST(MissionLimits, MeasureChargePerMetreFromTheFirstBatteryState) {
  MissionLimits limits(unlimited());
  limits.begin(1000.0);
  limits.add(charged(0.6));
  limits.add(charged(0.5));  // 0.1 for 200 m since the restart
  EXPECT_NEAR(limits.remaining_m(1.0, 1200.0), 0.3 / (0.1 / 200.0), 1e-6);
}

TEST(MissionLimits, KeepTheFirstReason) {
  MissionLimits limits(unlimited());
  EXPECT_FALSE(limits.reason());
  limits.add(GasReading{1, 0.0, 0.209, 0.0003});
  limits.add(GasReading{2, 0.02, 0.209, 0.0});
  EXPECT_EQ(limits.reason(), "300 ppm of carbon monoxide in the air");
}

TEST(MissionLimits, AcceptValuesAtTheLimit) {
  const MissionLimitsParams at = unlimited();
  MissionLimits limits(at);
  limits.add(
      GasReading{1, at.methane_max_share, at.oxygen_min_share, at.carbon_monoxide_max_share});
  const double depth_m = at.sinkage_max_m;
  limits.add(SinkageReading{1, {depth_m, depth_m, depth_m, depth_m}});
  EXPECT_FALSE(limits.reason());
}

}  // namespace
}  // namespace adit

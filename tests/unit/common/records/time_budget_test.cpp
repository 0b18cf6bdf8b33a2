// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "common/records/time_budget.hpp"

#include <gtest/gtest.h>

namespace adit {
namespace {

constexpr double kSpeedMS = 0.5;
constexpr double kStepS = 0.1;
constexpr double kTolerance = 1e-6;  // sums of tenths

/// A mission that publishes its vehicle state and pose at 10 Hz.
class TimeBudgetTest : public testing::Test {
 protected:
  void run(Phase phase, double seconds, double speed_m_s = 0.0, bool stopped = false) {
    MissionPhase now;
    now.utime = utime_;
    now.phase = phase;
    now.sequence = ++sequence_;
    budget_.add(now);
    VehicleState state;
    state.speed_m_s = speed_m_s;
    state.stopped = stopped;
    for (double left_s = seconds; left_s > kStepS / 2.0; left_s -= kStepS) {
      state.utime = utime_;
      budget_.add(state);
      budget_.add(utime_, {x_m_, 0.0, 0.0}, 0.0);
      utime_ += 100'000;
      x_m_ += speed_m_s * kStepS;
    }
  }

  [[nodiscard]] double seconds_of(Activity activity) const {
    return budget_.share(activity).duration_s;
  }

  TimeBudget budget_;

 private:
  std::int64_t utime_ = 1'000'000;
  std::int32_t sequence_ = 0;
  double x_m_ = 0.0;
};

TEST_F(TimeBudgetTest, DividesTheTimeOfAMission) {
  run(Phase::kWaiting, 1.0);
  run(Phase::kExplore, 0.5);
  run(Phase::kScan, 8.0);
  run(Phase::kPlan, 0.4);
  run(Phase::kExecute, 0.3);
  run(Phase::kExecute, 10.0, kSpeedMS);
  run(Phase::kExecute, 2.0, 0.0, true);
  run(Phase::kEnded, 5.0);
  EXPECT_NEAR(seconds_of(Activity::kWait), 1.0, kTolerance);
  EXPECT_NEAR(seconds_of(Activity::kExplore), 0.5, kTolerance);
  EXPECT_NEAR(seconds_of(Activity::kScan), 8.0, kTolerance);
  EXPECT_NEAR(seconds_of(Activity::kPlan), 0.4, kTolerance);
  EXPECT_NEAR(seconds_of(Activity::kStand), 0.3, kTolerance);
  EXPECT_NEAR(seconds_of(Activity::kDriveNew), 10.0, kTolerance);
  EXPECT_NEAR(seconds_of(Activity::kHeld), 2.0, kTolerance);
  EXPECT_NEAR(budget_.share(Activity::kDriveNew).distance_m, 5.0, kTolerance);
  EXPECT_NEAR(budget_.duration_s(), 22.2, kTolerance);  // nothing after the end
}

TEST_F(TimeBudgetTest, ScansWithoutAPathCountApart) {
  run(Phase::kScan, 8.0);
  run(Phase::kPlan, 0.5);
  run(Phase::kPlan, 0.5);  // another maneuver, as no path was found
  run(Phase::kExecute, 2.0, -kSpeedMS);
  run(Phase::kScan, 7.0);
  run(Phase::kPlan, 0.5);
  run(Phase::kExecute, 2.0, kSpeedMS);
  EXPECT_EQ(budget_.share(Activity::kScanWithoutPath).times, 1U);
  EXPECT_NEAR(seconds_of(Activity::kScanWithoutPath), 8.0, kTolerance);
  EXPECT_EQ(budget_.share(Activity::kScan).times, 1U);
  EXPECT_NEAR(seconds_of(Activity::kScan), 7.0, kTolerance);
}

TEST_F(TimeBudgetTest, TheReturnIsKnownGround) {
  run(Phase::kExecute, 20.0, kSpeedMS);
  run(Phase::kExecute, 20.0, -kSpeedMS);
  // The first metres back are still the visit that began outbound.
  EXPECT_NEAR(seconds_of(Activity::kDriveKnown), 20.0, 4.0);
  EXPECT_NEAR(seconds_of(Activity::kDriveNew) + seconds_of(Activity::kDriveKnown), 39.9,
              kTolerance);
}

}  // namespace
}  // namespace adit

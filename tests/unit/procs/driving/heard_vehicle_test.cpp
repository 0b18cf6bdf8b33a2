// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "procs/driving/heard_vehicle.hpp"

#include <gtest/gtest.h>

namespace adit {
namespace {

constexpr std::int64_t kUtime = 1'600'000'000'000'000;

VehicleState state(double speed_m_s, bool stopped, bool expired) {
  VehicleState state;
  state.utime = kUtime;
  state.speed_m_s = speed_m_s;
  state.stopped = stopped;
  state.expired = expired;
  return state;
}

TEST(HeardVehicle, BelievesThatOneObeysThatIsSilent) {
  const HeardVehicle vehicle;
  EXPECT_EQ(vehicle.speed_m_s(kUtime, 0.4), 0.4);
  EXPECT_EQ(vehicle.hold(kUtime), std::nullopt);
}

TEST(HeardVehicle, CanHaveComeToItsSpeedOnlySoFar) {
  HeardVehicle vehicle;
  vehicle.hear(state(-0.3, false, false));
  EXPECT_DOUBLE_EQ(vehicle.speed_m_s(kUtime + 50'000, -0.33), -0.33);
  EXPECT_DOUBLE_EQ(vehicle.speed_m_s(kUtime + 50'000, 0.0), -0.2);
  EXPECT_DOUBLE_EQ(vehicle.speed_m_s(kUtime + 150'000, -0.6), -0.5);
  EXPECT_EQ(vehicle.hold(kUtime), std::nullopt);
}

TEST(HeardVehicle, IsAsFastAsItSaysWhileItIsHeld) {
  HeardVehicle vehicle;
  vehicle.hear(state(0.1, true, false));
  EXPECT_EQ(vehicle.speed_m_s(kUtime + 100'000, 0.05), 0.1);
}

TEST(HeardVehicle, SaysWhyItIsHeld) {
  HeardVehicle vehicle;
  vehicle.hear(state(0.0, true, true));
  EXPECT_EQ(vehicle.hold(kUtime), "held by a stop order");
  vehicle.hear(state(0.0, false, true));
  EXPECT_EQ(vehicle.hold(kUtime), "held because commands come too late");
}

TEST(HeardVehicle, ForgetsWhatIsOldOrOfAnotherTime) {
  HeardVehicle vehicle;
  vehicle.hear(state(0.3, true, false));
  for (const std::int64_t apart : {-300'000, 300'000}) {
    EXPECT_EQ(vehicle.speed_m_s(kUtime + apart, 0.0), 0.0);
    EXPECT_EQ(vehicle.hold(kUtime + apart), std::nullopt);
  }
}

}  // namespace
}  // namespace adit

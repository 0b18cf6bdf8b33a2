// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "procs/guard/stop_release.hpp"

#include <cstdint>
#include <limits>
#include <optional>

#include <gtest/gtest.h>

#include "procs/guard/travel_direction.hpp"

namespace adit {
namespace {

constexpr std::int64_t kSecond = 1'000'000;

TEST(StopLatch, IsReleasedAfterAHoldTimeAndByANewerCommand) {
  StopLatch latch(0.5);
  EXPECT_TRUE(latch.evaluate(false, std::nullopt, 0));
  EXPECT_TRUE(latch.evaluate(false, 0, kSecond));  // the command is not newer than the last reason
  EXPECT_FALSE(latch.evaluate(false, 1, kSecond));
  EXPECT_TRUE(latch.evaluate(true, kSecond, 2 * kSecond));
  EXPECT_TRUE(latch.evaluate(false, 2 * kSecond + 1, 2 * kSecond + 499'999));
  EXPECT_TRUE(latch.evaluate(false, 2 * kSecond, 3 * kSecond));
  EXPECT_FALSE(latch.evaluate(false, 2 * kSecond + 1, 3 * kSecond));
}

TEST(StopLatch, RestartsItsHoldTimeWithEachReason) {
  StopLatch latch(0.5);
  for (int i = 0; i < 20; ++i) {  // a reason that comes and goes
    EXPECT_TRUE(latch.evaluate(i % 2 == 0, i * 300'000, i * 300'000));
  }
}

TEST(RetreatPermission, ForbidsToContinueAndPermitsToLeave) {
  RetreatPermission retreat;
  EXPECT_FALSE(retreat.forbids(false, 1, 1, 0));
  EXPECT_TRUE(retreat.forbids(true, 1, 1, kSecond));
  EXPECT_TRUE(retreat.forbids(true, 0, 1, 2 * kSecond));
  EXPECT_FALSE(retreat.forbids(true, -1, 1, 3 * kSecond));
  EXPECT_TRUE(retreat.forbids(true, 1, -1, 4 * kSecond));
}

/// As when it turned around before the hazard was measured, or rolls on while it brakes.
TEST(RetreatPermission, IsOfTheDirectionTravelledNotCommanded) {
  RetreatPermission retreat;
  retreat.forbids(false, 1, 1, 0);
  retreat.forbids(false, -1, 1, kSecond);
  EXPECT_FALSE(retreat.forbids(true, -1, 1, 2 * kSecond));
  EXPECT_TRUE(retreat.forbids(true, 1, 1, 3 * kSecond));
}

TEST(RetreatPermission, KeepsItsDirectionWhileTheHazardVaries) {
  RetreatPermission retreat;
  retreat.forbids(false, 1, 1, 0);
  retreat.forbids(true, 1, 1, kSecond);
  for (int i = 2; i < 100; ++i) EXPECT_FALSE(retreat.forbids(i % 9 == 0, -1, -1, i * kSecond));
}

TEST(RetreatPermission, HasANewDirectionForANewHazard) {
  RetreatPermission retreat;
  retreat.forbids(false, 1, 1, 0);
  retreat.forbids(true, 1, 1, kSecond);
  retreat.forbids(false, -1, -1, 2 * kSecond);
  retreat.forbids(false, -1, -1, 30 * kSecond);
  EXPECT_TRUE(retreat.forbids(true, -1, -1, 31 * kSecond));
  EXPECT_FALSE(retreat.forbids(true, 1, -1, 32 * kSecond));
}

TEST(RetreatPermission, PermitsNothingBeforeTheFirstDrive) {
  RetreatPermission retreat;
  EXPECT_TRUE(retreat.forbids(true, 1, 0, 0));
  EXPECT_TRUE(retreat.forbids(true, -1, 0, kSecond));
}

/// Drives for a time with readings at 20 Hz.
void drive(TravelDirection& travel, double speed_m_s, double duration_s, std::int64_t& now_us) {
  for (double s = 0.0; s < duration_s; s += 0.05) travel.add(speed_m_s, now_us += kSecond / 20);
}

TEST(TravelDirection, ChangesOnceTheVehicleHasTravelledBack) {
  TravelDirection travel;
  std::int64_t now_us = 0;
  drive(travel, 0.0, 1.0, now_us);
  EXPECT_EQ(travel.direction(), 0);
  drive(travel, 0.5, 2.0, now_us);
  EXPECT_EQ(travel.direction(), 1);
  drive(travel, -0.5, 0.5, now_us);  // 0.25 m
  EXPECT_EQ(travel.direction(), 1);
  drive(travel, -0.5, 0.2, now_us);
  EXPECT_EQ(travel.direction(), -1);
  drive(travel, 0.5, 0.5, now_us);
  drive(travel, -0.5, 0.5, now_us);  // to and fro
  drive(travel, 0.5, 0.5, now_us);
  EXPECT_EQ(travel.direction(), -1);
}

TEST(TravelDirection, IgnoresReadingsThatAreNoNumber) {
  TravelDirection travel;
  std::int64_t now_us = 0;
  drive(travel, 0.5, 1.0, now_us);
  drive(travel, std::numeric_limits<double>::quiet_NaN(), 1.0, now_us);
  EXPECT_EQ(travel.direction(), 1);
}

}  // namespace
}  // namespace adit

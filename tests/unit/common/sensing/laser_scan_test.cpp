// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "common/sensing/laser_scan.hpp"

#include <gtest/gtest.h>

#include "common/geometry/pose2.hpp"

namespace adit {
namespace {

const ScanTiming kTiming;

TEST(ScanTiming, OneDegreeTakesOneTurnOfTheMirror) {
  const double step = deg_to_rad(1.0);
  EXPECT_EQ(kTiming.turns(step), 1);
  EXPECT_DOUBLE_EQ(kTiming.scan_period_s(step), 1.0 / 75.0);
  EXPECT_DOUBLE_EQ(kTiming.beam_time_s(0, 181, step), 0.0);
  EXPECT_NEAR(kTiming.beam_time_s(90, 181, step), 1.0 / 300.0, 1e-15);   // a quarter of a turn
  EXPECT_NEAR(kTiming.beam_time_s(180, 181, step), 1.0 / 150.0, 1e-15);  // half of one
}

TEST(ScanTiming, HalfADegreeTakesTwoTurnsInterlaced) {
  const double step = deg_to_rad(0.5);
  EXPECT_EQ(kTiming.turns(step), 2);
  EXPECT_NEAR(kTiming.scan_period_s(step), 1.0 / 37.5, 1e-15);
  EXPECT_NEAR(kTiming.beam_time_s(360, 361, step), 1.0 / 150.0, 1e-15);
  EXPECT_NEAR(kTiming.beam_time_s(1, 361, step), 1.0 / 75.0 + 0.5 / 360.0 / 75.0, 1e-15);
  EXPECT_NEAR(kTiming.beam_time_s(359, 361, step), 1.0 / 75.0 + 179.5 / 360.0 / 75.0, 1e-15);
}

TEST(ScanTiming, TakesAsManyTurnsAsConfigured) {
  // A Hokuyo UTM-30LX: a quarter of a degree in one turn at 40 Hz.
  const ScanTiming hokuyo{.mirror_hz = 40.0, .mirror_turns = 1};
  EXPECT_DOUBLE_EQ(hokuyo.scan_period_s(deg_to_rad(0.25)), 1.0 / 40.0);
  EXPECT_NEAR(hokuyo.beam_time_s(1080, 1081, deg_to_rad(0.25)), 0.75 / 40.0, 1e-15);
  // A SICK LMS-200 at a quarter of a degree: every fourth beam in each of four turns.
  const ScanTiming sick{.mirror_hz = 75.0, .mirror_turns = 4};
  EXPECT_NEAR(sick.scan_period_s(deg_to_rad(0.25)), 4.0 / 75.0, 1e-15);
  EXPECT_NEAR(sick.beam_time_s(3, 401, deg_to_rad(0.25)), 3.0 / 75.0 + 0.75 / 360.0 / 75.0, 1e-15);
}

TEST(ScanTiming, MeasuresTheLastBeamFirstWhereItTurnsClockwise) {
  const ScanTiming lidar{.mirror_hz = 20.0, .mirror_turns = 1, .clockwise = true};
  const double step = deg_to_rad(0.4);
  EXPECT_DOUBLE_EQ(lidar.beam_time_s(899, 900, step), 0.0);
  EXPECT_NEAR(lidar.beam_time_s(0, 900, step), 0.05 * 899 / 900, 1e-15);
  EXPECT_DOUBLE_EQ(lidar.last_beam_time_s(900, step), lidar.beam_time_s(0, 900, step));
}

TEST(ScanTiming, KnowsTheLastBeamOfSeveralTurns) {
  EXPECT_DOUBLE_EQ(kTiming.last_beam_time_s(361, deg_to_rad(0.5)),
                   kTiming.beam_time_s(359, 361, deg_to_rad(0.5)));
  EXPECT_EQ(kTiming.last_beam_time_s(0, deg_to_rad(0.5)), 0.0);
}

TEST(ScanTiming, ScalesWithTheMirrorFrequency) {
  const ScanTiming slow{.mirror_hz = 10.0};
  EXPECT_NEAR(slow.scan_period_s(deg_to_rad(0.5)), 0.2, 1e-15);
  EXPECT_NEAR(slow.beam_time_s(180, 181, deg_to_rad(1.0)), 0.05, 1e-15);
}

}  // namespace
}  // namespace adit

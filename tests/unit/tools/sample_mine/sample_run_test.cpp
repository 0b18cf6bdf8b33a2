// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "tools/sample_mine/sample_run.hpp"

#include <gtest/gtest.h>

namespace adit {
namespace {

TEST(SampleRun, GivesAScanAndOdometryForEachMoment) {
  SampleRun run(1);
  std::size_t count = 0;
  while (const auto reading = run.next()) {
    ASSERT_EQ(reading->scan.utime, run.truth()[count].utime);
    ASSERT_EQ(reading->odometry.utime, run.truth()[count].utime);
    ++count;
  }
  EXPECT_EQ(count, run.truth().size());
  EXPECT_DOUBLE_EQ(run.fraction_done(), 1.0);
}

TEST(SampleRun, ItsOdometryIsWorthLessThanItsLaser) {
  SampleRun run(1);
  Pose2 last;
  while (const auto reading = run.next()) last = reading->odometry.T_wheel_body;
  const Pose2 truth = between(run.truth().front().pose, run.truth().back().pose);
  EXPECT_GT((last.translation() - truth.translation()).norm(), 1.0);
}

TEST(SampleRun, ComesFromItsSeed) {
  const auto first_scan = [](std::uint64_t seed) { return SampleRun(seed).next()->scan; };
  EXPECT_EQ(first_scan(3), first_scan(3));
  EXPECT_NE(first_scan(3), first_scan(4));
}

TEST(SampleRun, MayBeAtAnotherSite) {
  SampleRun ring(sample_site(SampleWorld::kRing, 1), 1);
  EXPECT_EQ(ring.next()->scan, SampleRun(1).next()->scan);
  SampleRun parallel(sample_site(SampleWorld::kParallel, 1), 1);
  EXPECT_NE(parallel.next()->scan, SampleRun(1).next()->scan);
}

TEST(SampleRun, AShorterOneIsTheBeginning) {
  constexpr double kLength = 20.0;
  SampleRun whole(1);
  SampleRun beginning(1, {}, kLength);
  EXPECT_NEAR(path_length_m(beginning.truth()), kLength, 0.16);  // a step between two scans
  EXPECT_LE(path_length_m(beginning.truth()), kLength);
  while (const auto reading = beginning.next()) EXPECT_EQ(reading->scan, whole.next()->scan);
  EXPECT_DOUBLE_EQ(beginning.fraction_done(), 1.0);
}

}  // namespace
}  // namespace adit

// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "procs/mission/narrow_passages.hpp"

#include <gtest/gtest.h>

namespace adit {
namespace {

constexpr int kFrontier = 3;

/// A scan 2.5 m before a place on the x axis of odom could not tell whether the vehicle fits.
class ANarrowPassage : public testing::Test {
 protected:
  ANarrowPassage() { passages_.add_doubt(kFrontier, {2.5, Pose2{10.0, 0.0, 0.0}}); }

  void drive(double from_x_m, double to_x_m, double y_m = 0.0) {
    for (double x = from_x_m; x <= to_x_m; x += 0.1) passages_.add_pose({x, y_m, 0.0});
  }
  [[nodiscard]] bool is_doubtful() const { return passages_.is_doubtful(kFrontier); }

  NarrowPassages passages_;
};

TEST_F(ANarrowPassage, IsDoubtful) {
  EXPECT_TRUE(is_doubtful());
  EXPECT_FALSE(passages_.is_doubtful(kFrontier + 1));
  EXPECT_FALSE(passages_.is_doubtful(std::nullopt));
}

TEST_F(ANarrowPassage, IsDecidedByTwoScansFromNearer) {
  passages_.add_blocked(kFrontier, 0.5);
  EXPECT_TRUE(is_doubtful());
  passages_.add_blocked(kFrontier, 0.3);
  EXPECT_FALSE(is_doubtful());
}

TEST_F(ANarrowPassage, IsNotDecidedByScansFromAsFar) {
  for (int i = 0; i < 5; ++i) passages_.add_blocked(kFrontier, 2.0);
  EXPECT_TRUE(is_doubtful());
}

TEST_F(ANarrowPassage, IsNotDecidedByScansToAnotherFrontier) {
  for (int i = 0; i < 5; ++i) passages_.add_blocked(kFrontier + 1, 0.5);
  EXPECT_TRUE(is_doubtful());
}

TEST_F(ANarrowPassage, IsDoubtfulAgainAfterANearerDoubt) {
  for (int i = 0; i < 2; ++i) passages_.add_blocked(kFrontier, 0.5);
  passages_.add_doubt(kFrontier, {0.4, Pose2{10.0, 0.0, 0.0}});
  EXPECT_TRUE(is_doubtful());
  for (int i = 0; i < 2; ++i) passages_.add_blocked(kFrontier, 0.1);
  EXPECT_TRUE(is_doubtful());
}

TEST_F(ANarrowPassage, StaysDecidedAfterADoubtFromFarther) {
  for (int i = 0; i < 2; ++i) passages_.add_blocked(kFrontier, 0.5);
  passages_.add_doubt(kFrontier, {3.0, Pose2{10.0, 0.0, 0.0}});
  EXPECT_FALSE(is_doubtful());
}

TEST_F(ANarrowPassage, IsDecidedByDrivingThrough) {
  drive(7.5, 10.9);
  EXPECT_TRUE(is_doubtful());
  drive(10.9, 11.2);
  EXPECT_FALSE(is_doubtful());
}

TEST_F(ANarrowPassage, IsNotDecidedByDrivingInAParallelTunnel) {
  drive(7.5, 15.0, 4.0);
  EXPECT_TRUE(is_doubtful());
}

TEST_F(ANarrowPassage, IsNotDecidedByPosesInAnotherOdomFrame) {
  passages_.reset_odom();
  drive(7.5, 15.0);
  EXPECT_TRUE(is_doubtful());
}

/// A drive through may fail for other reasons.
TEST_F(ANarrowPassage, StaysDoubtfulIfAPathLedThroughFromAsNear) {
  std::vector<PathPoint> path;
  for (double x = 9.5; x < 14.0; x += 0.1) path.push_back({{x, 0.0, 0.0}, 0.0, false, 0.0, 0.0});
  passages_.add_path(path);
  for (int i = 0; i < 5; ++i) passages_.add_blocked(kFrontier, 0.2);
  EXPECT_TRUE(is_doubtful());
}

}  // namespace
}  // namespace adit

// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "tools/eval/true_trajectory.hpp"

#include <stdexcept>

#include <gtest/gtest.h>

#include "common/bus/log_writer.hpp"
#include "common/messages/codec.hpp"
#include "common/messages/pose.hpp"
#include "tests/support/scratch_folder.hpp"

namespace adit {
namespace {

class TrueTrajectory : public testing::Test {
 protected:
  void write(std::int64_t utime, const std::string& channel, const Pose2& pose) {
    const auto bytes = encode(to_message(StampedPose{utime, pose, {}}));
    log_.write({utime, channel, bytes});
  }

  test::ScratchFolder folder_;
  LogWriter log_{folder_ / "run.lcmlog"};
};

TEST_F(TrueTrajectory, IsWhatTheLogHasOnItsChannel) {
  write(1'000'000, "TRUTH", {1.0, 2.0, 0.5});
  write(1'000'000, "POSE", {9.0, 9.0, 0.0});
  write(2'000'000, "TRUTH", {2.0, 2.0, -3.0});
  write(2'000'000, "TRUTH", {8.0, 8.0, 0.0});  // the same time again
  log_.close();
  const Trajectory truth = read_truth(folder_ / "run.lcmlog");
  ASSERT_EQ(truth.size(), 2U);
  EXPECT_EQ(truth[1].utime, 2'000'000);
  EXPECT_NEAR(between(truth[1].pose, {2.0, 2.0, -3.0}).vector().norm(), 0.0, 1e-9);
}

TEST_F(TrueTrajectory, SaysSoWhereThereIsNone) {
  write(1'000'000, "POSE", {});
  log_.close();
  EXPECT_THROW(read_truth(folder_ / "run.lcmlog"), std::runtime_error);
  EXPECT_THROW(read_truth(folder_ / "missing.lcmlog"), std::runtime_error);
}

}  // namespace
}  // namespace adit

// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "viewer/view/log_player.hpp"

#include <cstdint>
#include <filesystem>
#include <string>

#include <gtest/gtest.h>

#include "foxglove.pb.h"

#include "common/bus/channels.hpp"
#include "common/bus/log/lcm_log.hpp"
#include "common/messages/codec.hpp"
#include "common/messages/mapping/odometry.hpp"
#include "tests/support/scratch_folder.hpp"

namespace adit {
namespace {

using foxglove_protocol::PlaybackControl;
using foxglove_protocol::PlaybackStatus;

constexpr std::int64_t kStartUs = 1'700'000'000'000'000;
constexpr std::int64_t kSecondUs = 1'000'000;

/// A log of 100 s in which x of the robot is the time in seconds since its start.
class LogPlayerTest : public testing::Test {
 protected:
  LogPlayerTest() {
    LogWriter writer(folder_.path() / "run.lcmlog");
    for (int i = 0; i <= 1000; ++i) {
      const std::int64_t utime = kStartUs + kSecondUs / 10 * i;
      const auto bytes = encode(to_message(
          StampedPose{.utime = utime, .T_odom_body = {0.1 * i, 0.0, 0.0}, .v_body = {}}));
      writer.write({utime, channels::kPose, bytes});
    }
    writer.close();
  }

  static double x_of(LogPlayer& player) {
    for (TopicId topic = 0; topic < player.board().topics().size(); ++topic) {
      if (player.board().topics()[topic].name != "/pose") continue;
      foxglove::PoseInFrame pose;
      EXPECT_TRUE(pose.ParseFromString(*player.board().current(topic).front().bytes));
      return pose.pose().position().x();
    }
    return -1.0;
  }

  /// Advances at one wall time until nothing is left to do; whether the board was replaced.
  static bool settle(LogPlayer& player, std::int64_t wall_us) {
    bool replaced = false;
    do {
      replaced = player.advance(wall_us) || replaced;
    } while (player.state().status == PlaybackStatus::kBuffering);
    return replaced;
  }

  test::ScratchFolder folder_;
};

TEST_F(LogPlayerTest, PlaysAtTheSpeedThatIsAskedFor) {
  LogPlayer player({folder_.path() / "run.lcmlog"}, {});
  EXPECT_EQ(player.time_range(), std::pair(kStartUs, kStartUs + 100 * kSecondUs));
  settle(player, 1);
  EXPECT_NEAR(x_of(player), 0.0, 1e-9);
  settle(player, 1 + 10 * kSecondUs);
  EXPECT_NEAR(x_of(player), 10.0, 1e-9);
  player.control({.play = true, .speed = 4.0, .seek_ns = {}, .request_id = {}}, 1 + 10 * kSecondUs);
  settle(player, 1 + 15 * kSecondUs);
  EXPECT_NEAR(x_of(player), 30.0, 1e-9);
}

TEST_F(LogPlayerTest, PausesAndEnds) {
  LogPlayer player({folder_.path() / "run.lcmlog"}, {});
  settle(player, 1);
  settle(player, 1 + 5 * kSecondUs);
  player.control({.play = false, .speed = 1.0, .seek_ns = {}, .request_id = {}}, 1 + 5 * kSecondUs);
  settle(player, 1 + 50 * kSecondUs);
  EXPECT_NEAR(x_of(player), 5.0, 1e-9);
  EXPECT_EQ(player.state().status, PlaybackStatus::kPaused);
  player.control({.play = true, .speed = 1.0, .seek_ns = {}, .request_id = {}}, 1 + 50 * kSecondUs);
  settle(player, 1 + 200 * kSecondUs);
  EXPECT_NEAR(x_of(player), 100.0, 1e-9);
  EXPECT_EQ(player.state().status, PlaybackStatus::kEnded);
}

TEST_F(LogPlayerTest, SeeksForwardAndBack) {
  LogPlayer player({folder_.path() / "run.lcmlog"}, {});
  settle(player, 1);
  const auto state = player.control({.play = false,
                                     .speed = 1.0,
                                     .seek_ns = 1000 * (kStartUs + 60 * kSecondUs),
                                     .request_id = "a"},
                                    2);
  EXPECT_EQ(state.request_id, "a");
  EXPECT_EQ(state.time_ns, 1000 * (kStartUs + 60 * kSecondUs));
  EXPECT_FALSE(settle(player, 2));
  EXPECT_NEAR(x_of(player), 60.0, 1e-9);
  player.control({.play = false,
                  .speed = 1.0,
                  .seek_ns = 1000 * (kStartUs + 20 * kSecondUs),
                  .request_id = {}},
                 3);
  EXPECT_TRUE(settle(player, 3)) << "the clients must get the content again";
  EXPECT_NEAR(x_of(player), 20.0, 1e-9);
}

TEST_F(LogPlayerTest, StaysWithinTheLogWhateverIsAskedFor) {
  LogPlayer player({folder_.path() / "run.lcmlog"}, {});
  settle(player, 1);
  for (const std::int64_t seek_ns : {std::int64_t{0}, std::int64_t{9'000'000'000'000'000'000}}) {
    player.control({.play = true, .speed = 1e9, .seek_ns = seek_ns, .request_id = {}}, 2);
    settle(player, 3);
    EXPECT_GE(player.now_utime(), kStartUs);
    EXPECT_LE(player.now_utime(), kStartUs + 100 * kSecondUs);
  }
}

}  // namespace
}  // namespace adit

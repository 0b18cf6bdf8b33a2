// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "common/bus/node/node_host.hpp"

#include <cerrno>
#include <cstdint>
#include <sstream>
#include <stdexcept>
#include <string>
#include <system_error>
#include <vector>

#include <gtest/gtest.h>

#include "common/bus/channels.hpp"
#include "common/bus/memory_bus.hpp"
#include "common/bus/typed_messages.hpp"
#include "common/files/file_error.hpp"
#include "common/messages/diagnostics.hpp"
#include "common/service/node_end.hpp"

namespace adit {
namespace {

constexpr std::int64_t kStart = 1'600'000'000'000'000;
constexpr std::int64_t kSecond = 1'000'000;

/// A bus with subscriptions to what NodeHost publishes.
class NodeHostTest : public testing::Test {
 protected:
  NodeHostTest() {
    const Delivery all = Delivery::queued(1000);
    subscribe<heartbeat_t>(bus_, channels::kHeartbeat, all,
                           [this](const Heartbeat& it) { heartbeats_.push_back(it); });
    subscribe<config_t>(bus_, channels::kConfig, all,
                        [this](const ConfigSnapshot& it) { configs_.push_back(it); });
    subscribe<stage_stats_t>(bus_, channels::kStageStats, all,
                             [this](const StageStats& it) { stats_.push_back(it); });
  }

  /// Subscribes to POSE and rejects empty messages.
  static void subscribe_to_poses(Bus& bus) {
    bus.subscribe("POSE", Delivery::latest(),
                  [](const ReceivedMessage& received) -> std::string_view {
                    return received.bytes.empty() ? "empty" : "";
                  });
  }

  void run_for(std::int64_t seconds) {
    for (std::int64_t i = 0; i <= 10 * seconds; ++i) bus_.advance_to(kStart + i * kSecond / 10);
  }

  MemoryBus bus_;
  std::vector<Heartbeat> heartbeats_;
  std::vector<ConfigSnapshot> configs_;
  std::vector<StageStats> stats_;
};

TEST_F(NodeHostTest, PublishesTheConfigurationAtTheStartAndEveryTenSeconds) {
  const NodeHost host(bus_, {"mapping", "0.1.0", "a: 1\n"});
  run_for(25);
  ASSERT_EQ(configs_.size(), 3U);
  EXPECT_EQ(configs_[0], (ConfigSnapshot{kStart, "mapping", "0.1.0", "a: 1\n"}));
  EXPECT_EQ(configs_[1].utime, kStart + 10 * kSecond);
}

TEST_F(NodeHostTest, PublishesAHeartbeatEverySecond) {
  const NodeHost host(bus_, {"mapping", "0.1.0", ""});
  run_for(3);
  ASSERT_EQ(heartbeats_.size(), 4U);
  EXPECT_EQ(heartbeats_[3], (Heartbeat{kStart + 3 * kSecond, "mapping", {}, 0, 0, 0}));
}

TEST_F(NodeHostTest, ReportsTheHealthOfTheNode) {
  NodeHost host(bus_, {"mapping", "0.1.0", ""});
  host.set_health([] { return Health{Health::Level::kDegraded, "no odometry"}; });
  run_for(0);
  EXPECT_EQ(heartbeats_.at(0).health, (Health{Health::Level::kDegraded, "no odometry"}));
}

TEST_F(NodeHostTest, CountsOnlyMessagesOfItsStage) {
  NodeHost mapping(bus_, {"mapping", "0.1.0", ""});
  NodeHost planning(bus_, {"planning", "0.1.0", ""});
  subscribe_to_poses(mapping.bus());
  run_for(0);
  bus_.publish("POSE", {});
  bus_.publish("POSE", std::vector<std::uint8_t>{1});
  run_for(1);
  EXPECT_EQ(heartbeats_.at(2), (Heartbeat{kStart + kSecond, "mapping", {}, 1, 1, 0}));
  EXPECT_EQ(heartbeats_.at(3), (Heartbeat{kStart + kSecond, "planning", {}, 0, 0, 0}));
}

TEST_F(NodeHostTest, ReportsEachIntervalIndependentOfTheComputer) {
  NodeHost host(bus_, {"mapping", "0.1.0", ""});
  subscribe_to_poses(host.bus());
  run_for(0);
  bus_.publish("POSE", std::vector<std::uint8_t>{1});
  run_for(5);
  bus_.publish("POSE", {});
  run_for(10);
  ASSERT_EQ(stats_.size(), 2U);
  EXPECT_EQ(stats_[0],
            (StageStats{kStart + 5 * kSecond, "mapping", 5.0, {{"POSE", 1, 0, 0, -1.0, -1.0}}}));
  EXPECT_EQ(stats_[1],
            (StageStats{kStart + 10 * kSecond, "mapping", 5.0, {{"POSE", 0, 1, 0, -1.0, -1.0}}}));
}

TEST_F(NodeHostTest, MeasuresHandlerTimesOnRequest) {
  NodeHost host(bus_, {"mapping", "0.1.0", ""}, StageBus::Measure::kHandlerTimes);
  subscribe_to_poses(host.bus());
  run_for(0);
  bus_.publish("POSE", {});
  run_for(5);
  EXPECT_GE(stats_.at(0).subscriptions.at(0).handler_mean_ms, 0.0);
  EXPECT_GE(stats_.at(0).subscriptions.at(0).handler_max_ms,
            stats_.at(0).subscriptions.at(0).handler_mean_ms);
}

TEST_F(NodeHostTest, IsDegradedWhileMostMessagesOfAChannelAreRejected) {
  NodeHost host(bus_, {"mapping", "0.1.0", ""});
  subscribe_to_poses(host.bus());
  run_for(0);
  for (int i = 0; i < 6; ++i) bus_.publish("POSE", {});
  bus_.publish("POSE", std::vector<std::uint8_t>{1});
  run_for(2);
  EXPECT_EQ(heartbeats_.at(1).health,
            (Health{Health::Level::kDegraded, "6 of 7 messages on POSE rejected: empty"}));
  EXPECT_EQ(heartbeats_.at(2).health, Health{});
}

TEST_F(NodeHostTest, ReportsEachKindOfRejectionOnce) {
  std::ostringstream errors;
  NodeHost host(bus_, {"mapping", "0.1.0", ""}, StageBus::Measure::kNothing, &errors);
  subscribe_to_poses(host.bus());
  run_for(0);
  bus_.publish("POSE", {});
  bus_.publish("POSE", {});
  run_for(5);
  EXPECT_EQ(errors.str(), "mapping: POSE rejected: empty\n");
}

TEST_F(NodeHostTest, ContainsAHandlerThatFails) {
  std::ostringstream errors;
  NodeHost host(bus_, {"mapping", "0.1.0", ""}, StageBus::Measure::kNothing, &errors);
  int handled = 0;
  host.bus().subscribe("POSE", Delivery::queued(9),
                       [&handled](const ReceivedMessage& received) -> std::string_view {
                         if (received.bytes.empty()) throw std::length_error("no bytes");
                         ++handled;
                         return {};
                       });
  run_for(1);
  EXPECT_EQ(heartbeats_.back().health, Health{});
  bus_.publish("POSE", {});
  bus_.publish("POSE", std::vector<std::uint8_t>{1});
  EXPECT_EQ(handled, 1);
  EXPECT_EQ(host.subscription_stats()[0].rejections.at("the handler failed"), 1);
  for (int i = 11; i <= 100; ++i) bus_.advance_to(kStart + i * kSecond / 10);
  const Health failed{Health::Level::kDegraded,
                      "1 messages or timers failed, the last: POSE: no bytes"};
  EXPECT_EQ(heartbeats_.back().health, failed);  // as long as the stage runs
  EXPECT_EQ(errors.str(),
            "mapping: POSE rejected: the handler failed\nmapping: " + failed.reason + "\n");
}

TEST_F(NodeHostTest, ContainsATimerThatFails) {
  NodeHost host(bus_, {"mapping", "0.1.0", ""});
  host.bus().create_timer(kSecond, [](std::int64_t) { throw std::logic_error("too far"); });
  run_for(3);
  EXPECT_EQ(host.failures().count, 4);
  EXPECT_EQ(host.failures().last, "a timer: too far");
}

/// A stage ends without its files and devices, or if it must.
TEST_F(NodeHostTest, PassesOnFailuresOfFilesAndDevices) {
  NodeHost host(bus_, {"mapping", "0.1.0", ""});
  host.bus().subscribe("POSE", Delivery::queued(9), [](const ReceivedMessage&) -> std::string_view {
    throw FileError("/maps/1: no space left");
  });
  host.bus().subscribe("IMU", Delivery::queued(9), [](const ReceivedMessage&) -> std::string_view {
    throw std::system_error(EIO, std::generic_category());
  });
  host.bus().subscribe("GAS", Delivery::queued(9), [](const ReceivedMessage&) -> std::string_view {
    throw NodeEnd("another one runs");
  });
  EXPECT_THROW(bus_.publish("GAS", {}), NodeEnd);
  EXPECT_THROW(bus_.publish("POSE", {}), FileError);
  EXPECT_THROW(bus_.publish("IMU", {}), std::system_error);
  EXPECT_EQ(host.failures().count, 0);
}

}  // namespace
}  // namespace adit

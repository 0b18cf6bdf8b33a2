// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
// LCM inside of this process (memq). tests/live has what takes a network.
#include "common/bus/lcm_bus.hpp"

#include <array>
#include <stdexcept>
#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

namespace adit {
namespace {

using testing::ElementsAre;

std::vector<std::uint8_t> bytes(const std::string& text) { return {text.begin(), text.end()}; }

class LcmBusTest : public testing::Test {
 protected:
  Handler keep() {
    return [this](const Received& received) -> std::string_view {
      kept_.emplace_back(received.bytes.begin(), received.bytes.end());
      return {};
    };
  }

  void handle_all() {
    while (bus_.handle(0)) {
    }
  }

  LcmBus bus_{{"memq://", 16}};
  std::vector<std::string> kept_;
};

TEST_F(LcmBusTest, DeliversInOrder) {
  bus_.subscribe("POSE", Delivery::queued(10), keep());
  for (const char* text : {"1", "2", "3"}) bus_.publish("POSE", bytes(text));
  handle_all();
  EXPECT_THAT(kept_, ElementsAre("1", "2", "3"));
}

TEST_F(LcmBusTest, DeliversToEverySubscriptionOfAChannel) {
  bus_.subscribe("POSE", Delivery::queued(10), keep());
  bus_.subscribe("POSE", Delivery::queued(10), keep());
  bus_.publish("POSE", bytes("a"));
  handle_all();
  EXPECT_THAT(kept_, ElementsAre("a", "a"));
}

TEST_F(LcmBusTest, KeepsOnlyTheNewestForAStateThatWaits) {
  bus_.subscribe("POSE", Delivery::latest(), keep());
  for (int i = 0; i < 100; ++i) bus_.publish("POSE", bytes(std::to_string(i)));
  handle_all();
  EXPECT_THAT(kept_, ElementsAre("99"));
}

TEST_F(LcmBusTest, KeepsTheNewestOfAFullQueueAndCountsTheRest) {
  const auto id = bus_.subscribe("POSE", Delivery::queued(2), keep());
  for (int i = 0; i < 100; ++i) bus_.publish("POSE", bytes(std::to_string(i)));
  handle_all();
  EXPECT_THAT(kept_, ElementsAre("98", "99"));
  EXPECT_EQ(bus_.stats(id).dropped, 98);
}

TEST_F(LcmBusTest, RefusesMessagesThatAreTooLarge) {
  const auto id = bus_.subscribe("POSE", Delivery::queued(2), keep());
  bus_.publish("POSE", std::vector<std::uint8_t>(17));
  handle_all();
  EXPECT_EQ(bus_.stats(id).refusals.at("too large"), 1);
}

TEST_F(LcmBusTest, PassesAHandlersExceptionOnAndGoesOnAfterwards) {
  bus_.subscribe("IMU", Delivery::latest(),
                 [](const Received&) -> std::string_view { throw std::runtime_error("broken"); });
  bus_.subscribe("POSE", Delivery::latest(), keep());
  bus_.publish("IMU", {});
  EXPECT_THROW(handle_all(), std::runtime_error);
  bus_.publish("POSE", bytes("a"));
  handle_all();
  EXPECT_THAT(kept_, ElementsAre("a"));
}

TEST_F(LcmBusTest, RunsTimersWithoutMessages) {
  int ticks = 0;
  bus_.every(1000, [&](std::int64_t) { ++ticks; });
  while (ticks < 3) bus_.handle(1000);
}

TEST_F(LcmBusTest, StopsWhenToldTo) {
  std::array<int, 2> pipe_ends{};
  ASSERT_EQ(pipe(pipe_ends.data()), 0);
  bus_.subscribe("POSE", Delivery::latest(), [&](const Received&) -> std::string_view {
    EXPECT_EQ(write(pipe_ends[1], "x", 1), 1);
    return {};
  });
  bus_.publish("POSE", {});
  bus_.run(pipe_ends[0]);
  close(pipe_ends[0]);
  close(pipe_ends[1]);
}

TEST(LcmBus, ThrowsForAUrlThatIsNone) { EXPECT_THROW(LcmBus({"nonsense://"}), std::runtime_error); }

}  // namespace
}  // namespace adit

// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
// LCM within one process (memq). tests/live has the tests that use a network.
#include "common/bus/lcm_bus.hpp"

#include <array>
#include <stdexcept>
#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include "common/bus/channels.hpp"
#include "common/bus/typed_messages.hpp"
#include "common/messages/sim.hpp"

namespace adit {
namespace {

using testing::ElementsAre;
using testing::IsEmpty;

std::vector<std::uint8_t> bytes(const std::string& text) { return {text.begin(), text.end()}; }

class LcmBusTest : public testing::Test {
 protected:
  Handler record_messages() {
    return [this](const ReceivedMessage& received) -> std::string_view {
      recorded_.emplace_back(received.bytes.begin(), received.bytes.end());
      return {};
    };
  }

  void handle_all() {
    while (bus_.handle(0)) {
    }
  }

  LcmBus bus_{{"memq://", 16}};
  std::vector<std::string> recorded_;
};

TEST_F(LcmBusTest, DeliversInOrder) {
  bus_.subscribe("POSE", Delivery::queued(10), record_messages());
  for (const char* text : {"1", "2", "3"}) bus_.publish("POSE", bytes(text));
  handle_all();
  EXPECT_THAT(recorded_, ElementsAre("1", "2", "3"));
}

TEST_F(LcmBusTest, DeliversToEverySubscriptionOfAChannel) {
  bus_.subscribe("POSE", Delivery::queued(10), record_messages());
  bus_.subscribe("POSE", Delivery::queued(10), record_messages());
  bus_.publish("POSE", bytes("a"));
  handle_all();
  EXPECT_THAT(recorded_, ElementsAre("a", "a"));
}

TEST_F(LcmBusTest, KeepsOnlyTheNewestOfAState) {
  bus_.subscribe("POSE", Delivery::latest(), record_messages());
  for (int i = 0; i < 100; ++i) bus_.publish("POSE", bytes(std::to_string(i)));
  handle_all();
  EXPECT_THAT(recorded_, ElementsAre("99"));
}

TEST_F(LcmBusTest, DropsTheOldestOfAFullQueueAndCountsThem) {
  const auto id = bus_.subscribe("POSE", Delivery::queued(2), record_messages());
  for (int i = 0; i < 100; ++i) bus_.publish("POSE", bytes(std::to_string(i)));
  handle_all();
  EXPECT_THAT(recorded_, ElementsAre("98", "99"));
  EXPECT_EQ(bus_.stats(id).dropped, 98);
}

TEST_F(LcmBusTest, CallsTheHandlerOfADeviceThatIsReadable) {
  std::array<int, 2> pipe_ends{};
  ASSERT_EQ(pipe(pipe_ends.data()), 0);
  std::string read_bytes;
  bus_.watch(pipe_ends[0], [&] {
    char byte = 0;
    if (read(pipe_ends[0], &byte, 1) == 1) read_bytes += byte;
  });
  bus_.handle(0);
  EXPECT_EQ(read_bytes, "");
  ASSERT_EQ(write(pipe_ends[1], "ab", 2), 2);
  bus_.handle(1000);
  bus_.handle(1000);
  bus_.handle(0);
  EXPECT_EQ(read_bytes, "ab");
  for (const int end : pipe_ends) close(end);
}

TEST_F(LcmBusTest, RejectsOversizedMessages) {
  const auto id = bus_.subscribe("POSE", Delivery::queued(2), record_messages());
  bus_.publish("POSE", std::vector<std::uint8_t>(17));
  handle_all();
  EXPECT_EQ(bus_.stats(id).rejections.at("too large"), 1);
}

TEST_F(LcmBusTest, PropagatesAHandlersExceptionAndContinues) {
  bus_.subscribe("IMU", Delivery::latest(), [](const ReceivedMessage&) -> std::string_view {
    throw std::runtime_error("broken");
  });
  bus_.subscribe("POSE", Delivery::latest(), record_messages());
  bus_.publish("IMU", {});
  EXPECT_THROW(handle_all(), std::runtime_error);
  bus_.publish("POSE", bytes("a"));
  handle_all();
  EXPECT_THAT(recorded_, ElementsAre("a"));
}

TEST_F(LcmBusTest, RunsTimersWithoutMessages) {
  constexpr std::int64_t kPeriodUs = 1000;
  std::vector<std::int64_t> ticks;
  bus_.create_timer(kPeriodUs, [&](std::int64_t utime) { ticks.push_back(utime); });
  for (int i = 0; i < 100 && ticks.size() < 3; ++i) {
    EXPECT_FALSE(bus_.handle(1000)) << "no message was sent";
  }
  ASSERT_GE(ticks.size(), 3U);
  // A late tick does not delay the next, so only the sum of two periods is certain.
  EXPECT_GE(ticks[2] - ticks[0], kPeriodUs);
  EXPECT_LT(ticks[0], ticks[2]);
}

TEST_F(LcmBusTest, StopsWhenTheDescriptorIsReadable) {
  std::array<int, 2> pipe_ends{};
  ASSERT_EQ(pipe(pipe_ends.data()), 0);
  const auto id =
      bus_.subscribe("POSE", Delivery::queued(10), [&](const ReceivedMessage&) -> std::string_view {
        EXPECT_EQ(write(pipe_ends[1], "x", 1), 1);
        return {};
      });
  bus_.publish("POSE", {});
  bus_.publish("POSE", {});
  bus_.run(pipe_ends[0]);
  EXPECT_EQ(bus_.stats(id).handled, 1) << "the second message is not handled";
  close(pipe_ends[0]);
  close(pipe_ends[1]);
}

LcmBusOptions sim_time_options(const std::string& stage) {
  LcmBusOptions options;
  options.url = "memq://";
  options.time = BusTime::kSimulated;
  options.stage = stage;
  return options;
}

class LcmBusSimTime : public testing::Test {
 protected:
  LcmBusSimTime() {
    subscribe<sim_time_done_t>(bus_, channels::kSimTimeDone, Delivery::queued(100),
                               [this](const SimTimeDone& done) {
                                 events_.push_back(done.stage + " " + std::to_string(done.utime));
                               });
  }

  void send_time(std::int64_t utime) {
    publish(bus_, channels::kSimTime, to_message(SimTime{utime}));
  }
  void handle_all() {
    while (bus_.handle(0)) {
    }
  }

  LcmBus bus_{sim_time_options("mapping")};
  std::vector<std::string> events_;
};

TEST_F(LcmBusSimTime, HasTimeZeroAndRunsNoTimersBeforeTheFirstTime) {
  bus_.create_timer(1, [&](std::int64_t) { events_.emplace_back("tick"); });
  handle_all();
  EXPECT_EQ(bus_.now_utime(), 0);
  EXPECT_THAT(events_, IsEmpty());
}

TEST_F(LcmBusSimTime, RunsTimersOnSimulatedTime) {
  bus_.create_timer(100, [&](std::int64_t utime) {
    events_.push_back("tick " + std::to_string(utime) + " " + std::to_string(bus_.now_utime()));
  });
  for (const std::int64_t utime : {5000, 5050, 5100}) {
    send_time(utime);
    handle_all();
  }
  EXPECT_THAT(events_, ElementsAre("tick 5000 5000", "mapping 5000", "mapping 5050",
                                   "tick 5100 5100", "mapping 5100"));
}

TEST_F(LcmBusSimTime, RunsWallTimersWithoutSimulatedTime) {
  int ticks = 0;
  bus_.create_wall_timer(1000, [&](std::int64_t utime) {
    EXPECT_EQ(utime, bus_.now_utime());
    ++ticks;
  });
  while (ticks < 3) bus_.handle(100);
  EXPECT_EQ(bus_.now_utime(), 0);
  send_time(5000);
  handle_all();
  const int before = ticks;
  while (ticks < before + 3) bus_.handle(100);
  EXPECT_EQ(bus_.now_utime(), 5000);
}

TEST_F(LcmBusSimTime, AcknowledgesAfterAllEarlierMessagesAreHandled) {
  for (const char* channel : {"POSE", "IMU"}) {
    bus_.subscribe(channel, Delivery::queued(10), [this](const ReceivedMessage& received) {
      events_.push_back(std::string(received.channel) + " " + std::to_string(bus_.now_utime()));
      return std::string_view();
    });
  }
  bus_.publish("IMU", {});
  bus_.publish("POSE", {});
  send_time(70);
  bus_.publish("POSE", {});
  send_time(80);
  handle_all();
  EXPECT_THAT(events_, ElementsAre("IMU 0", "POSE 0", "POSE 70", "mapping 70", "mapping 80"));
}

TEST_F(LcmBusSimTime, FollowsASimulatorThatRestarts) {
  send_time(90'000'000);
  send_time(1'000'000);
  handle_all();
  EXPECT_EQ(bus_.now_utime(), 1'000'000);
}

TEST(LcmBus, DoesNotAcknowledgeTimeWithoutAStage) {
  LcmBus bus(sim_time_options(""));
  const auto id = bus.subscribe(channels::kSimTimeDone, Delivery::latest(),
                                [](const ReceivedMessage&) { return std::string_view(); });
  publish(bus, channels::kSimTime, to_message(SimTime{7}));
  while (bus.handle(0)) {
  }
  EXPECT_EQ(bus.now_utime(), 7);
  EXPECT_EQ(bus.stats(id).handled, 0);
}

TEST(LcmBus, ThrowsForAnInvalidUrl) { EXPECT_THROW(LcmBus({"nonsense://"}), std::runtime_error); }

}  // namespace
}  // namespace adit

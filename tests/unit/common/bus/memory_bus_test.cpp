// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "common/bus/memory_bus.hpp"

#include <stdexcept>
#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace adit {
namespace {

using testing::ElementsAre;
using testing::IsEmpty;

constexpr std::int64_t kSecond = 1'000'000;

std::vector<std::uint8_t> bytes(const std::string& text) { return {text.begin(), text.end()}; }

/// A handler that records messages.
Handler record_messages(std::vector<std::string>& recorded) {
  return [&recorded](const ReceivedMessage& received) -> std::string_view {
    recorded.emplace_back(received.bytes.begin(), received.bytes.end());
    return {};
  };
}

/// A handler that publishes 1, 2, 3 on another channel.
Handler publish_three(Bus& bus, std::string_view channel) {
  return [&bus, channel](const ReceivedMessage&) -> std::string_view {
    for (const char* number : {"1", "2", "3"}) bus.publish(channel, bytes(number));
    return {};
  };
}

TEST(MemoryBus, DeliversToEverySubscriptionOfAChannel) {
  MemoryBus bus;
  std::vector<std::string> first;
  std::vector<std::string> second;
  std::vector<std::string> other;
  bus.subscribe("POSE", Delivery::queued(10), record_messages(first));
  bus.subscribe("POSE", Delivery::queued(10), record_messages(second));
  bus.subscribe("IMU", Delivery::queued(10), record_messages(other));
  bus.publish("POSE", bytes("a"));
  EXPECT_THAT(first, ElementsAre("a"));
  EXPECT_THAT(second, ElementsAre("a"));
  EXPECT_THAT(other, IsEmpty());
}

TEST(MemoryBus, HandlesNestedPublicationsAfterTheHandlerInOrder) {
  MemoryBus bus;
  std::vector<std::string> order;
  bus.subscribe("IMU", Delivery::queued(10), [&](const ReceivedMessage&) -> std::string_view {
    bus.publish("POSE", bytes("first"));
    bus.publish("POSE", bytes("second"));
    order.emplace_back("handler is done");
    return {};
  });
  bus.subscribe("POSE", Delivery::queued(10), record_messages(order));
  bus.publish("IMU", {});
  EXPECT_THAT(order, ElementsAre("handler is done", "first", "second"));
}

TEST(MemoryBus, KeepsOnlyTheNewestOfAState) {
  MemoryBus bus;
  std::vector<std::string> recorded;
  bus.subscribe("IMU", Delivery::queued(10), publish_three(bus, "POSE"));
  const auto id = bus.subscribe("POSE", Delivery::latest(), record_messages(recorded));
  bus.publish("IMU", {});
  EXPECT_THAT(recorded, ElementsAre("3"));
  EXPECT_EQ(bus.stats(id).dropped, 0);
}

TEST(MemoryBus, DropsTheOldestOfAFullQueueAndCountsIt) {
  MemoryBus bus;
  std::vector<std::string> recorded;
  bus.subscribe("IMU", Delivery::queued(10), publish_three(bus, "POSE"));
  const auto id = bus.subscribe("POSE", Delivery::queued(2), record_messages(recorded));
  bus.publish("IMU", {});
  EXPECT_THAT(recorded, ElementsAre("2", "3"));
  EXPECT_EQ(bus.stats(id).dropped, 1);
  EXPECT_EQ(bus.stats(id).handled, 2);
}

TEST(MemoryBus, CountsRejectionsByReason) {
  MemoryBus bus;
  const auto id = bus.subscribe("POSE", Delivery::latest(), [](const ReceivedMessage& received) {
    return received.bytes.empty() ? std::string_view("empty") : std::string_view();
  });
  bus.publish("POSE", {});
  bus.publish("POSE", {});
  bus.publish("POSE", bytes("a"));
  EXPECT_EQ(bus.stats(id).handled, 1);
  EXPECT_EQ(bus.stats(id).rejected, 2);
  EXPECT_EQ(bus.stats(id).rejections.at("empty"), 2);
}

TEST(MemoryBus, RejectsOversizedMessages) {
  MemoryBus bus(3);
  std::vector<std::string> recorded;
  const auto id = bus.subscribe("POSE", Delivery::queued(10), record_messages(recorded));
  bus.publish("POSE", bytes("abcd"));
  bus.publish("POSE", bytes("abc"));
  EXPECT_THAT(recorded, ElementsAre("abc"));
  EXPECT_EQ(bus.stats(id).rejections.at("too large"), 1);
}

TEST(MemoryBus, ThrowsForInvalidChannelNames) {
  MemoryBus bus;
  for (const std::string& name :
       std::vector<std::string>{"", "pose", "A B", "A.*", std::string(64, 'A')}) {
    EXPECT_THROW(bus.publish(name, {}), std::invalid_argument) << name;
    EXPECT_THROW(bus.subscribe(name, Delivery::latest(), {}), std::invalid_argument) << name;
  }
  EXPECT_NO_THROW(bus.publish(std::string(63, 'A'), {}));
}

TEST(MemoryBus, PropagatesAHandlersExceptionAndContinues) {
  MemoryBus bus;
  std::vector<std::string> recorded;
  bus.subscribe("IMU", Delivery::latest(), [](const ReceivedMessage&) -> std::string_view {
    throw std::runtime_error("broken");
  });
  bus.subscribe("POSE", Delivery::latest(), record_messages(recorded));
  EXPECT_THROW(bus.publish("IMU", {}), std::runtime_error);
  bus.publish("POSE", bytes("a"));
  EXPECT_THAT(recorded, ElementsAre("a"));
}

TEST(MemoryBus, TakesBusTimeFromInjectedMessages) {
  MemoryBus bus;
  std::vector<std::int64_t> times;
  bus.subscribe("POSE", Delivery::latest(),
                [&](const ReceivedMessage& received) -> std::string_view {
                  times.push_back(received.utime);
                  times.push_back(bus.now_utime());
                  return {};
                });
  bus.inject(5 * kSecond, "POSE", {});
  EXPECT_THAT(times, ElementsAre(5 * kSecond, 5 * kSecond));
}

TEST(MemoryBus, KeepsBusTimeMonotonic) {
  MemoryBus bus;
  std::int64_t utime = 0;
  bus.subscribe("POSE", Delivery::latest(),
                [&](const ReceivedMessage& received) -> std::string_view {
                  utime = received.utime;
                  return {};
                });
  bus.inject(5 * kSecond, "POSE", {});
  bus.inject(4 * kSecond, "POSE", {});
  EXPECT_EQ(utime, 5 * kSecond);
}

TEST(MemoryBus, RunsDueTimersBeforeTheInjectedMessage) {
  MemoryBus bus;
  std::vector<std::string> order;
  bus.create_timer(kSecond,
                   [&](std::int64_t utime) { order.push_back(std::to_string(utime / kSecond)); });
  bus.subscribe("POSE", Delivery::queued(10), record_messages(order));
  bus.inject(1 * kSecond, "POSE", bytes("a"));
  bus.inject(3 * kSecond, "POSE", bytes("b"));
  EXPECT_THAT(order, ElementsAre("1", "a", "2", "3", "b"));
}

TEST(MemoryBus, HandlesPublicationsOfATimerBeforeTheNextTimer) {
  MemoryBus bus;
  std::vector<std::string> order;
  bus.create_timer(kSecond, [&](std::int64_t utime) {
    order.emplace_back("tick");
    bus.publish("POSE", bytes(std::to_string(utime / kSecond)));
  });
  bus.subscribe("POSE", Delivery::latest(), record_messages(order));
  bus.advance_to(1 * kSecond);
  bus.advance_to(3 * kSecond);
  EXPECT_THAT(order, ElementsAre("tick", "1", "tick", "2", "tick", "3"));
}

TEST(MemoryBus, PassesEveryMessageToTheTapInOrder) {
  MemoryBus bus;
  std::vector<std::string> seen;
  bus.tap([&](const ReceivedMessage& received) { seen.emplace_back(received.channel); });
  bus.subscribe("IMU", Delivery::latest(), [&](const ReceivedMessage&) -> std::string_view {
    bus.publish("POSE", {});
    return {};
  });
  bus.publish("IMU", {});
  bus.publish("LASER_FRONT", {});
  EXPECT_THAT(seen, ElementsAre("IMU", "POSE", "LASER_FRONT"));
}

}  // namespace
}  // namespace adit

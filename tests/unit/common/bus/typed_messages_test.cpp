// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "common/bus/typed_messages.hpp"

#include <limits>

#include <gtest/gtest.h>

#include "common/bus/channels.hpp"
#include "common/bus/memory_bus.hpp"
#include "common/messages/sensing.hpp"

namespace adit {
namespace {

const LaserScan kScan{17, {1.0F, 2.0F}, -1.5, 0.5};

TEST(TypedSubscription, PassesTheMessage) {
  MemoryBus bus;
  std::int32_t beams = 0;
  subscribe<planar_lidar_t>(bus, channels::kLaserFront, Delivery::latest(),
                            [&](const planar_lidar_t& message) { beams = message.nranges; });
  publish(bus, channels::kLaserFront, to_message(kScan));
  EXPECT_EQ(beams, 2);
}

TEST(TypedSubscription, PassesTheConvertedValue) {
  MemoryBus bus;
  LaserScan received;
  subscribe<planar_lidar_t>(bus, channels::kLaserFront, Delivery::latest(),
                            [&](const LaserScan& scan) { received = scan; });
  publish(bus, channels::kLaserFront, to_message(kScan));
  EXPECT_EQ(received, kScan);
}

TEST(TypedSubscription, CountsDecodingAndConversionErrors) {
  MemoryBus bus;
  const auto id = subscribe<planar_lidar_t>(bus, channels::kLaserFront, Delivery::queued(9),
                                            [](const LaserScan&) { FAIL(); });
  planar_lidar_t message = to_message(kScan);
  std::vector<std::uint8_t> truncated = encode(message);
  truncated.resize(30);
  bus.publish(channels::kLaserFront, truncated);
  message.rad0 = std::numeric_limits<float>::infinity();
  publish(bus, channels::kLaserFront, message);
  EXPECT_EQ(bus.stats(id).rejected, 2);
  EXPECT_EQ(bus.stats(id).rejections.at("truncated, or invalid count"), 1);
  EXPECT_EQ(bus.stats(id).rejections.at("implausible first bearing"), 1);
}

}  // namespace
}  // namespace adit

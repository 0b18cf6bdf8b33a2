// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "tests/support/lossy_bus.hpp"

#include <cmath>

#include <gtest/gtest.h>

#include "common/bus/channels.hpp"
#include "common/bus/memory_bus.hpp"

namespace adit {
namespace {

int received_on(std::string_view channel, double share, std::uint64_t seed, int sent) {
  MemoryBus memory;
  test::LossyBus bus(memory, share, seed);
  int received = 0;
  const auto id =
      bus.subscribe(channel, Delivery::queued(10), [&](const ReceivedMessage&) -> std::string_view {
        ++received;
        return {};
      });
  for (int i = 0; i < sent; ++i) bus.publish(channel, {});
  EXPECT_EQ(bus.stats(id).handled, sent);
  EXPECT_EQ(bus.lost(), sent - received);
  return received;
}

TEST(LossyBus, LosesTheShareOfTheMessages) {
  const int sent = 2000;
  const double five_sigma = 5.0 * std::sqrt(sent * 0.2 * 0.8);  // of a binomial distribution
  EXPECT_NEAR(received_on("POSE", 0.2, 1, sent), 0.8 * sent, five_sigma);
  EXPECT_EQ(received_on("POSE", 0.0, 1, sent), sent);
  EXPECT_EQ(received_on("POSE", 1.0, 1, sent), 0);
}

TEST(LossyBus, NeverLosesSimulatedTime) {
  EXPECT_EQ(received_on(channels::kSimTime, 0.9, 1, 100), 100);
  EXPECT_EQ(received_on(channels::kSimTimeDone, 0.9, 1, 100), 100);
}

TEST(LossyBus, IsReproducible) {
  EXPECT_EQ(received_on("POSE", 0.5, 7, 1000), received_on("POSE", 0.5, 7, 1000));
}

}  // namespace
}  // namespace adit

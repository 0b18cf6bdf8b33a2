// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "tools/report/records/map_record.hpp"

#include <cmath>
#include <cstdint>

#include <gtest/gtest.h>

#include "common/bus/channels.hpp"
#include "common/bus/memory_bus.hpp"
#include "common/bus/typed_messages.hpp"
#include "common/messages/mapping/odometry.hpp"

namespace adit {
namespace {

constexpr std::int64_t kStart = 1'600'000'000'000'000;

TEST(MapRecord, LeavesOutATruthThatNoVehicleReaches) {
  MemoryBus bus;
  const MapRecord record(bus);
  for (int i = 0; i < 100; ++i) {
    const std::int64_t utime = kStart + i * 100'000;
    for (const double x_m : {0.05 * i, 1e9, -9e4, 50.0 + i % 7 * 30.0}) {
      const StampedPose truth{utime, {x_m, 0.0, 0.0}, {}};
      bus.inject(utime, channels::kTruth, encode(to_message(truth)));
    }
  }
  EXPECT_GT(record.truth().size(), 90U);
  for (const TimedPose& at : record.truth()) EXPECT_LE(std::abs(at.pose.x), 5.0);
}

}  // namespace
}  // namespace adit

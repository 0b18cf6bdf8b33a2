// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "common/messages/procman.hpp"

#include <limits>

#include <gtest/gtest.h>

namespace adit {
namespace {

constexpr std::int64_t kUtime = 1'600'000'000'000'000;
const ProcmanCommand kCommand{"mapping", "adit-mapping", "slam/maps", true, 15, 2.5};
const ProcmanInfo kInfo{
    kUtime, "robot", {0.5, 800, 300, 20, 10}, {{kCommand, 4711, 3, 9, 0.75, 1200, 400}}};
const ProcmanOrders kOrders{kUtime, "robot", "base", {{kCommand, 4, false}, {kCommand, 5, true}}};
const double kNan = std::numeric_limits<double>::quiet_NaN();

TEST(ProcmanMessages, SurviveARoundTrip) {
  const ProcmanOutput output{kUtime, "robot", {{"a", "one\ntwo"}, {"b", ""}}};
  const ProcmanDiscovery discovery{kUtime, "base", 7};
  EXPECT_EQ(*from_message(to_message(kInfo)), kInfo);
  EXPECT_EQ(*from_message(to_message(kOrders)), kOrders);
  EXPECT_EQ(*from_message(to_message(output)), output);
  EXPECT_EQ(*from_message(to_message(discovery)), discovery);
}

TEST(ProcmanMessages, AreRejectedWithInvalidContent) {
  const auto rejection = [](const auto& value) {
    return from_message(to_message(value)).rejection();
  };
  ProcmanInfo info = kInfo;
  info.utime = -1;
  EXPECT_EQ(rejection(info), "time outside 1970 to 2286");
  info = kInfo;
  info.deputy.clear();
  EXPECT_EQ(rejection(info), "no deputy");
  info = kInfo;
  info.load.cpu_share = kNan;
  EXPECT_EQ(rejection(info), "load is negative or not finite");
  info = kInfo;
  info.commands[0].pid = -1;
  EXPECT_EQ(rejection(info), "negative process id");
  info = kInfo;
  info.commands[0].cpu_cores = kNan;
  EXPECT_EQ(rejection(info), "processor usage is negative or not finite");
  ProcmanOrders orders = kOrders;
  orders.sheriff.clear();
  EXPECT_EQ(rejection(orders), "no sheriff");
  orders = kOrders;
  orders.orders[1].command.id.clear();
  EXPECT_EQ(rejection(orders), "command without a name");
  orders = kOrders;
  orders.orders[1].command.stop_signal = 65;
  EXPECT_EQ(rejection(orders), "unknown stop signal");
  orders = kOrders;
  orders.orders[1].command.stop_time_allowed_s = kNan;
  EXPECT_EQ(rejection(orders), "stop time is negative or not finite");
  EXPECT_EQ(rejection(ProcmanOutput{kUtime, "robot", {{"", "x"}}}), "command without a name");
  EXPECT_EQ(rejection(ProcmanOutput{kUtime, "", {}}), "no deputy");
  EXPECT_EQ(rejection(ProcmanDiscovery{-1, "x", 0}), "time outside 1970 to 2286");
}

}  // namespace
}  // namespace adit

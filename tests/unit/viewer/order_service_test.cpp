// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "viewer/view/order_service.hpp"

#include <cstdint>
#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "common/bus/channels.hpp"
#include "common/bus/memory_bus.hpp"
#include "common/bus/typed_messages.hpp"
#include "common/messages/mission.hpp"
#include "common/seal/secret_text.hpp"

namespace adit {
namespace {

using testing::ElementsAre;
using testing::IsEmpty;

constexpr std::int64_t kStartUs = 1'700'000'000'000'000;

class OrderServiceTest : public testing::Test {
 protected:
  OrderServiceTest() {
    subscribe<mission_order_t>(
        bus_, channels::kMissionOrder, Delivery::queued(100),
        [this](const MissionOrder& order) { orders_.push_back(order.kind); });
    bus_.advance_to(kStartUs);
  }

  Result<std::string> call(const std::string& service, const std::string& payload) {
    for (const auto& offered : OrderService::services()) {
      if (offered.name == service)
        return service_.call(
            {.service = offered.id, .call = 1, .encoding = "json", .payload = payload});
    }
    return Rejected{"no such service"};
  }

  MemoryBus bus_;
  std::vector<MissionOrder::Kind> orders_;
  std::vector<std::string> controlled_;
  OrderService service_{bus_, "secret", [this](const std::string& action, const std::string& name) {
                          controlled_.push_back(action + " " + name);
                          return name == "unknown" ? "no such process" : "";
                        }};
};

TEST_F(OrderServiceTest, TakesNoOrderWithoutTheToken) {
  for (const char* payload :
       {R"({"order":"stop"})", R"({"order":"stop","token":""})",
        R"({"order":"stop","token":"secre"})", R"({"order":"stop","token":"secreT"})",
        R"({"order":"stop","token":["secret"]})", "[]", "{", ""}) {
    EXPECT_FALSE(call("adit/order", payload)) << payload;
  }
  EXPECT_FALSE(call("adit/process", R"({"action":"stop","process":"guard","token":"x"})"));
  bus_.advance_to(kStartUs + 2'000'000);
  EXPECT_THAT(orders_, IsEmpty());
  EXPECT_THAT(controlled_, IsEmpty());
}

TEST_F(OrderServiceTest, RepeatsAnOrderUntilTheMissionExecutesIt) {
  EXPECT_TRUE(call("adit/order", R"({"order":"pause","token":"secret"})"));
  bus_.advance_to(kStartUs + 1'000'000);
  EXPECT_GE(orders_.size(), 5U);
  EXPECT_EQ(orders_.front(), MissionOrder::Kind::kPause);
  MissionPhase phase;
  phase.utime = kStartUs;
  phase.phase = Phase::kPaused;
  publish(bus_, channels::kPhase, to_message(phase));
  orders_.clear();
  bus_.advance_to(kStartUs + 3'000'000);
  EXPECT_THAT(orders_, IsEmpty());
}

TEST_F(OrderServiceTest, TakesTheOrdersOfTheCommandOnly) {
  for (const char* order : {"pause", "resume", "return_home", "stop"})
    EXPECT_TRUE(call("adit/order", std::string(R"({"token":"secret","order":")") + order + "\"}"));
  for (const char* order : {"", "drive", "Pause", "return home"})
    EXPECT_FALSE(call("adit/order", std::string(R"({"token":"secret","order":")") + order + "\"}"));
}

TEST_F(OrderServiceTest, ControlsProcesses) {
  EXPECT_TRUE(call("adit/process", R"({"token":"secret","action":"restart","process":"mapping"})"));
  EXPECT_FALSE(call("adit/process", R"({"token":"secret","action":"kill","process":"mapping"})"));
  const auto failed =
      call("adit/process", R"({"token":"secret","action":"stop","process":"unknown"})");
  EXPECT_EQ(failed.rejection(), "no such process");
  EXPECT_THAT(controlled_, ElementsAre("restart mapping", "stop unknown"));
}

TEST(OrderToken, DiffersEachTime) {
  EXPECT_EQ(random_secret().size(), 32U);
  EXPECT_NE(random_secret(), random_secret());
}

}  // namespace
}  // namespace adit

// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "procs/supervisor/procman/local_deputy.hpp"
#include "procs/supervisor/procman/remote_deputies.hpp"

namespace adit {
namespace {

using testing::IsEmpty;
using testing::SizeIs;

constexpr std::int64_t kSecond = 1'000'000;
constexpr std::int64_t kUtime = 1'600'000'000'000'000;

ListedCommand listed(const std::string& id, const std::string& deputy) {
  ListedCommand command;
  command.id = id;
  command.exec = std::string("x");
  command.deputy = deputy;
  return command;
}

ProcmanOrders from(const std::string& sheriff) { return {kUtime, "robot", sheriff, {}}; }

TEST(OrderPolicy, RejectsAllSheriffsByDefault) {
  EXPECT_THAT(rejection_reason(OrderPolicy{}, from("any")), testing::HasSubstr("foreign"));
}

TEST(OrderPolicy, AcceptsOnlyTheSupervisorInCharge) {
  const OrderPolicy policy{"base", false};
  EXPECT_THAT(rejection_reason(policy, from("base")), IsEmpty());
  EXPECT_THAT(rejection_reason(policy, from("other")), testing::HasSubstr("foreign"));
}

TEST(OrderPolicy, AcceptsAllSheriffsIfConfigured) {
  EXPECT_THAT(rejection_reason(OrderPolicy{"", true}, from("any")), IsEmpty());
}

TEST(OrderPolicy, AcceptsOnlyCommandsAndCommandLinesOfTheList) {
  const ListedCommand command = listed("slam", "robot");
  const auto reason = [&](const std::string& exec) {
    ProcmanOrder order;
    order.command.id = "slam";
    order.command.exec = exec;
    return rejection_reason(&command, order);
  };
  EXPECT_THAT(reason("x"), IsEmpty());
  EXPECT_THAT(reason(""), IsEmpty());
  EXPECT_EQ(reason("x; rm -rf /"), "order with another command line than listed");
  EXPECT_EQ(rejection_reason(nullptr, ProcmanOrder{}),
            "order for a command that is not in the list of this computer");
}

class RemoteDeputiesTest : public testing::Test {
 protected:
  static ProcessList list() {
    ListedCommand seen = listed("seen", "far");
    seen.alive = LivenessSignal{"POSE", 1.0};
    return {{listed("here", "robot"), listed("there", "far"), seen}, {}};
  }

  void receive(const std::string& id, int pid, std::int32_t run_id, std::int64_t now_us,
               const std::string& deputy = "far") {
    ProcmanStatus status;
    status.command.id = id;
    status.pid = pid;
    status.run_id = run_id;
    remotes_.on_message({kUtime, deputy, {}, {status}}, now_us);
  }

  std::optional<ProcmanOrder> order() {
    const auto all = remotes_.orders("robot", kUtime);
    if (all.empty()) return std::nullopt;
    EXPECT_EQ(all.front().deputy, "far");
    EXPECT_EQ(all.front().sheriff, "robot");
    return all.front().orders.front();
  }

  RemoteDeputies remotes_{list(), "robot"};
};

TEST_F(RemoteDeputiesTest, OrderNothingWithoutARequest) {
  receive("there", 17, 3, 0);
  EXPECT_THAT(remotes_.orders("robot", kUtime), IsEmpty());
  EXPECT_FALSE(remotes_.has("here"));
}

TEST_F(RemoteDeputiesTest, WaitForTheStatusBeforeOrdering) {
  remotes_.start("there");
  EXPECT_FALSE(order());
  receive("there", 0, 7, 0);
  EXPECT_EQ(order()->run_id, 8);
  EXPECT_FALSE(order()->stop);
  EXPECT_EQ(order()->command.exec, "x");
}

TEST_F(RemoteDeputiesTest, DoNotRestartARunningCommand) {
  receive("there", 17, 7, 0);
  remotes_.start("there");
  EXPECT_EQ(order()->run_id, 7);
  remotes_.restart("there");
  EXPECT_EQ(order()->run_id, 8);
  EXPECT_EQ(order()->run_id, 8);  // repeated, not incremented
}

TEST_F(RemoteDeputiesTest, ReportTheProgressOfAnOrder) {
  EXPECT_EQ(remotes_.process_state("there", 0), ProcessState::kChanging);  // no status received
  receive("there", 0, 7, 0);
  EXPECT_EQ(remotes_.process_state("there", 0), ProcessState::kStopped);
  remotes_.start("there");
  EXPECT_EQ(remotes_.process_state("there", 0), ProcessState::kChanging);
  order();
  EXPECT_EQ(remotes_.process_state("there", 0), ProcessState::kChanging);
  receive("there", 17, 8, kSecond);
  EXPECT_EQ(remotes_.process_state("there", kSecond), ProcessState::kRunning);
  remotes_.stop("there");
  order();
  EXPECT_EQ(remotes_.process_state("there", kSecond), ProcessState::kChanging);
  receive("there", 0, 8, 2 * kSecond);
  EXPECT_EQ(remotes_.process_state("there", 2 * kSecond), ProcessState::kStopped);
}

TEST_F(RemoteDeputiesTest, HaveNoStatusOfATimedOutDeputy) {
  receive("there", 17, 1, 0);
  EXPECT_EQ(remotes_.status("there", 5 * kSecond)->pid, 17);
  EXPECT_FALSE(remotes_.status("there", 5 * kSecond + 1));
  EXPECT_EQ(remotes_.process_state("there", 5 * kSecond + 1), ProcessState::kChanging);
}

TEST_F(RemoteDeputiesTest, AcceptStatusOnlyFromTheDeputyOfTheList) {
  receive("there", 17, 1, 0, "other");
  EXPECT_FALSE(remotes_.status("there", 0));
}

TEST_F(RemoteDeputiesTest, RequireTheLivenessSignal) {
  receive("seen", 17, 1, 0);
  EXPECT_EQ(remotes_.process_state("seen", 0), ProcessState::kChanging);
  remotes_.on_message("POSE", 0);
  EXPECT_EQ(remotes_.process_state("seen", 0), ProcessState::kRunning);
}

}  // namespace
}  // namespace adit

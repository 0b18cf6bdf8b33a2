// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
// The stage with real processes, on an in-memory bus that runs in real time.
#include "procs/supervisor/supervisor_node.hpp"

#include <atomic>
#include <csignal>
#include <fstream>
#include <memory>
#include <string>
#include <thread>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/wait.h>

#include "common/bus/channels.hpp"
#include "common/bus/memory_bus.hpp"
#include "common/bus/typed_messages.hpp"
#include "common/messages/procman.hpp"
#include "procs/supervisor/control/control_client.hpp"
#include "tests/support/scratch_folder.hpp"
#include "tests/unit/procs/supervisor/processes.hpp"

namespace adit {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using testing::IsEmpty;

constexpr std::int64_t kStart = 1'600'000'000'000'000;
constexpr const char* kList = R"(
group "g" { cmd "talk" { exec = "sh -c 'echo hello; exec sleep 1000'"; deputy = "robot"; } }
cmd "quiet" { exec = "sleep 1000"; alive_channel = "POSE"; start_timeout_s = 60; }
cmd "far" { exec = "sleep 1000"; deputy = "sensors"; }
script "go" { start group "g" wait "running"; start cmd "quiet" wait "running"; start cmd "far"; }
script "hopeless" { wait cmd "quiet" status "running" timeout_s 0; }
)";

class SupervisorNodeTest : public testing::Test {
 protected:
  SupervisorNodeTest() {
    std::ofstream(folder_ / "list.cfg") << kList;
    params_.processes = folder_ / "list.cfg";
    params_.deputy_id = "robot";
    params_.socket = folder_ / "s.sock";
    params_.watcher = ADIT_WATCH;
    params_.listen_s = 0.0;  // NameClaim has tests of its own
    bus_.tap([this](const ReceivedMessage& received) { take(received); });
  }

  void take(const ReceivedMessage& received) {
    if (received.channel == channels::kPmInfo) {
      info_ = *from_message(*decode<procman_lcm::deputy_info_t>(received.bytes));
      ++infos_;
    } else if (received.channel == channels::kPmOrders) {
      orders_.push_back(*from_message(*decode<procman_lcm::orders_t>(received.bytes)));
    } else if (received.channel == channels::kPmOutput) {
      const auto output = from_message(*decode<procman_lcm::output_t>(received.bytes));
      for (const auto& text : output->texts) printed_ += text.id + ": " + text.text;
    }
  }

  void start_node() { node_ = std::make_unique<SupervisorNode>(bus_, params_); }

  void run_on() {
    utime_ += 20'000;
    bus_.advance_to(utime_);
  }

  bool becomes_true(const std::function<bool()>& condition) {
    return test::becomes_true([&] {
      run_on();
      return condition();
    });
  }

  [[nodiscard]] ProcmanStatus status(const std::string& id) const {
    for (const ProcmanStatus& status : info_.commands) {
      if (status.command.id == id) return status;
    }
    return {};
  }

  /// Publishes an order as procman's sheriff does.
  void order(const std::string& sheriff, const std::string& id, const std::string& exec,
             std::int32_t run_id, bool stop = false) {
    ProcmanOrder order;
    order.command.id = id;
    order.command.exec = exec;
    order.run_id = run_id;
    order.stop = stop;
    publish(bus_, channels::kPmOrders,
            to_message(ProcmanOrders{kStart, "robot", sheriff, {order}}));
  }

  [[nodiscard]] const SubscriptionStats& order_stats() const { return bus_.stats(0); }

  /// Response to a control request, sent from another thread since the node runs on this one.
  std::string control_request(const std::vector<std::string>& request) {
    std::string response;
    std::atomic<bool> done = false;
    std::jthread thread([&] {
      try {
        response = request_from_supervisor(params_.socket, request);
      } catch (const std::runtime_error& error) {
        response = std::string("error: ") + error.what();
      }
      done = true;
    });
    EXPECT_TRUE(becomes_true([&] { return done.load(); }));
    thread.join();
    return response;
  }

  test::ScratchFolder folder_;
  SupervisorParams params_;
  MemoryBus bus_;
  std::unique_ptr<SupervisorNode> node_;
  std::int64_t utime_ = kStart;
  ProcmanInfo info_;
  int infos_ = 0;
  std::vector<ProcmanOrders> orders_;
  std::string printed_;
};

TEST_F(SupervisorNodeTest, PublishesProcessStatesLikeProcman) {
  start_node();
  run_on();
  EXPECT_EQ(info_.deputy, "robot");
  ASSERT_EQ(info_.commands.size(), 2U);  // without the remote command
  EXPECT_EQ(info_.commands[0].command,
            (ProcmanCommand{"talk", "sh -c 'echo hello; exec sleep 1000'", "g", false, 2, 7.0}));
  EXPECT_EQ(info_.commands[0].pid, 0);
  EXPECT_GT(info_.load.memory_bytes, 0);
}

TEST_F(SupervisorNodeTest, PublishesInfoPeriodicallyOnChangeAndOnDiscovery) {
  start_node();
  bus_.advance_to(kStart);
  infos_ = 0;
  utime_ = kStart + 5'000'000;
  bus_.advance_to(utime_);
  EXPECT_EQ(infos_, 5);
  publish(bus_, channels::kPmDiscover, to_message(ProcmanDiscovery{kStart, "sheriff", 1}));
  EXPECT_EQ(infos_, 6);
  EXPECT_EQ(control_request({"start", "talk"}), "");
  EXPECT_TRUE(becomes_true([&] { return status("talk").pid > 0; }));
}

TEST_F(SupervisorNodeTest, RejectsForeignOrdersByDefault) {
  start_node();
  run_on();
  order("sheriff", "talk", "", 5);
  EXPECT_EQ(order_stats().rejected, 1);
  EXPECT_THAT(order_stats().rejections.begin()->first, HasSubstr("foreign sheriff"));
  run_on();
  EXPECT_EQ(status("talk").pid, 0);
}

TEST_F(SupervisorNodeTest, ExecutesOrdersOfListedCommandsIfAccepted) {
  params_.accept_orders = true;
  start_node();
  order("sheriff", "talk", status("talk").command.exec, 5);
  ASSERT_TRUE(becomes_true([&] { return status("talk").pid > 0; }));
  EXPECT_EQ(status("talk").run_id, 5);
  EXPECT_TRUE(becomes_true([&] { return printed_ == "talk: hello\n"; })) << printed_;
  order("sheriff", "talk", "sh -c evil", 6);
  order("sheriff", "evil", "sh -c evil", 6);
  order("sheriff", "far", "", 6);
  EXPECT_EQ(order_stats().rejected, 3);
  run_on();
  EXPECT_EQ(status("talk").run_id, 5);
  order("sheriff", "talk", "", 5, true);
  ASSERT_TRUE(becomes_true([&] { return status("talk").pid == 0; }));
  EXPECT_EQ(WTERMSIG(status("talk").wait_status), SIGINT);
  EXPECT_EQ(node_->health(), Health{});
}

TEST_F(SupervisorNodeTest, AsADeputyExecutesOrdersOfTheSupervisorInCharge) {
  params_.role = "deputy";
  params_.in_charge = "base";
  start_node();
  order("stranger", "talk", "", 1);
  order("base", "talk", "", 2);
  EXPECT_EQ(order_stats().rejected, 1);
  ASSERT_TRUE(becomes_true([&] { return status("talk").pid > 0; }));
  EXPECT_EQ(status("talk").run_id, 2);
  EXPECT_THAT(control_request({"start", "far"}), HasSubstr("\"far\" runs on sensors, and this"));
  EXPECT_THAT(orders_, testing::SizeIs(2));  // published by this test
}

TEST_F(SupervisorNodeTest, RunsItsStartScriptAndPublishesOrders) {
  params_.start_script = "go";
  start_node();
  ASSERT_TRUE(becomes_true([&] { return status("quiet").pid > 0; }));
  EXPECT_GT(status("talk").pid, 0);
  publish(bus_, channels::kPmInfo,
          to_message(ProcmanInfo{kStart, "sensors", {}, {{{"far", "", "", false, 0, 0.0}, 0, 3}}}));
  run_on();
  EXPECT_THAT(orders_, IsEmpty());  // the script waits for the liveness channel
  EXPECT_TRUE(becomes_true([&] {
    bus_.publish(channels::kPose, {});
    return !orders_.empty();
  }));
  EXPECT_EQ(orders_.back().deputy, "sensors");
  EXPECT_EQ(orders_.back().sheriff, "robot");
  ASSERT_EQ(orders_.back().orders.size(), 1U);
  EXPECT_EQ(orders_.back().orders[0].command.id, "far");
  EXPECT_EQ(orders_.back().orders[0].run_id, 4);
}

TEST_F(SupervisorNodeTest, ReportsWhyAScriptFailed) {
  params_.start_script = "hopeless";
  start_node();
  run_on();
  EXPECT_EQ(node_->health().level, Health::Level::kDegraded);
  EXPECT_THAT(node_->health().reason, HasSubstr("timed out waiting for \"quiet\""));
}

TEST_F(SupervisorNodeTest, ServesControlRequests) {
  start_node();
  EXPECT_EQ(control_request({"start", "talk"}), "");
  ASSERT_TRUE(becomes_true([&] { return !printed_.empty(); }));
  EXPECT_EQ(control_request({"logs", "talk"}), "hello\n");
  EXPECT_THAT(control_request({"ps"}), AllOf(HasSubstr("talk\trobot\tg\trunning\t"),
                                             HasSubstr("quiet\trobot\t\tstopped\t0\t"),
                                             HasSubstr("far\tsensors\t\tunknown\t0\t")));
  EXPECT_EQ(control_request({"stop"}), "");  // all processes
  EXPECT_TRUE(becomes_true([&] { return status("talk").pid == 0; }));
  EXPECT_THAT(control_request({"start", "talk", "none"}), HasSubstr("no process \"none\""));
  run_on();
  EXPECT_EQ(status("talk").pid, 0);  // the request has no partial effect
  EXPECT_THAT(control_request({"logs", "far"}), HasSubstr("no output received from sensors"));
  EXPECT_THAT(control_request({"logs", "none"}), HasSubstr("no process \"none\""));
  EXPECT_THAT(control_request({"script", "none"}), HasSubstr("no script \"none\""));
  EXPECT_THAT(control_request({"dance"}), HasSubstr("unknown request"));
}

TEST_F(SupervisorNodeTest, ShowsOutputOfRemoteProcesses) {
  start_node();
  const auto printed = [&](const std::string& deputy, const std::string& id, const char* text) {
    publish(bus_, channels::kPmOutput, to_message(ProcmanOutput{kStart, deputy, {{id, text}}}));
  };
  printed("sensors", "far", "one\n");
  printed("stranger", "far", "lie\n");
  printed("sensors", "unlisted", "lie\n");
  printed("robot", "talk", "lie\n");  // own output, received from the bus
  printed("sensors", "far", "two\n\x1b[2J");
  EXPECT_EQ(control_request({"logs", "far"}), "one\ntwo\n");
  EXPECT_EQ(control_request({"logs", "talk"}), "");
}

TEST_F(SupervisorNodeTest, StopsInDependencyOrderAcrossComputers) {
  std::ofstream(folder_ / "list.cfg") << R"(cmd "near" { exec = "sleep 1000"; deputy = "robot"; }
    cmd "far" { exec = "sleep 1000"; deputy = "sensors"; depends_on = "near"; })";
  start_node();
  const auto far_is = [&](std::int32_t pid) {
    const ProcmanStatus far{{"far", "", "", false, 0, 0.0}, pid, 3};
    publish(bus_, channels::kPmInfo, to_message(ProcmanInfo{kStart, "sensors", {}, {far}}));
  };
  control_request({"start", "near"});
  ASSERT_TRUE(becomes_true([&] { return status("near").pid > 0; }));
  far_is(17);
  EXPECT_EQ(control_request({"stop"}), "");
  ASSERT_TRUE(becomes_true([&] { return !orders_.empty(); }));
  EXPECT_TRUE(orders_.back().orders[0].stop);
  for (int i = 0; i < 5; ++i) run_on();
  EXPECT_THAT(control_request({"ps"}), AllOf(HasSubstr("near\trobot\t\trunning"),
                                             HasSubstr("waits for its dependents to stop")));
  far_is(0);
  EXPECT_TRUE(
      becomes_true([&] { return control_request({"ps"}).starts_with("near\trobot\t\tstopped"); }));
}

TEST_F(SupervisorNodeTest, ReportsAFailedProcess) {
  std::ofstream(folder_ / "list.cfg") << R"(cmd "bad" { exec = "false"; })";
  start_node();
  control_request({"start", "bad"});
  EXPECT_TRUE(becomes_true([&] { return node_->health().level == Health::Level::kFault; }));
  EXPECT_EQ(node_->health().reason, "bad is failed: ended with exit code 1");
}

TEST_F(SupervisorNodeTest, RejectsAnInvalidConfiguration) {
  const auto error_of = [&](const SupervisorParams& params) -> std::string {
    try {
      const SupervisorNode node(bus_, params);
    } catch (const std::runtime_error& error) {
      return error.what();
    }
    return "none";
  };
  SupervisorParams params = params_;
  params.processes.clear();
  EXPECT_THAT(error_of(params), HasSubstr("supervisor.processes is not set"));
  params.processes = folder_ / "none.cfg";
  EXPECT_THAT(error_of(params), HasSubstr("cannot read"));
  params = params_;
  params.start_script = "none";
  EXPECT_THAT(error_of(params), HasSubstr("has no script \"none\""));
  params = params_;
  params.watcher = "/nonexistent";
  EXPECT_THAT(error_of(params), HasSubstr("/nonexistent is not executable"));
  params = params_;
  params.log_dir = "/proc/logs";
  EXPECT_THAT(error_of(params), HasSubstr("/proc/logs is not writable"));
  params = params_;
  params.role = "deputy";
  EXPECT_THAT(error_of(params), HasSubstr("command \"quiet\" has no deputy"));
}

TEST_F(SupervisorNodeTest, RestartsAProcessThatIgnoresItsInputAndSaysSo) {
  std::ofstream(folder_ / "list.cfg") << R"(
cmd "deaf" { exec = "sleep 1000"; deputy = "robot"; auto_respawn = "true"; start_timeout_s = 0;
             answer_channel = "POSE"; answers_to = "LASER_FRONT"; answer_timeout_s = 0.3; })";
  start_node();
  run_on();
  EXPECT_EQ(control_request({"start", "deaf"}), "");
  EXPECT_TRUE(becomes_true([&] {
    bus_.publish(channels::kLaserFront, {});
    return status("deaf").pid > 0 &&
           node_->health() ==
               Health{Health::Level::kDegraded,
                      "deaf was restarted: ignored its input: no POSE for 0.3 s while LASER_FRONT "
                      "came"};
  })) << node_->health().reason;
  EXPECT_THAT(control_request({"ps"}), HasSubstr("\t1 (1)\t"));
}

}  // namespace
}  // namespace adit

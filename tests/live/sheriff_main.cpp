// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
// live_sheriff: sends and receives the messages of procman's sheriff, to test the supervisor.
//   await DEPUTY COMMAND running|stopped     waits for this state in PM_INFO; prints the process id
//   order DEPUTY SHERIFF COMMAND EXEC RUN_ID start|stop     sends PM_ORDERS for half a second
//   output DEPUTY COMMAND TEXT               waits for the text in PM_OUTPUT
// Exit code 0, or 1 after a timeout of ten seconds.
#include <chrono>
#include <functional>
#include <iostream>
#include <string>
#include <vector>

#include "procman_lcm/deputy_info_t.hpp"
#include "procman_lcm/discovery_t.hpp"
#include "procman_lcm/orders_t.hpp"
#include "procman_lcm/output_t.hpp"

#include "common/bus/channels.hpp"
#include "common/bus/lcm_bus.hpp"
#include "common/messages/codec.hpp"

namespace {

using adit::LcmBus;

using Clock = std::chrono::steady_clock;
constexpr auto kTimeout = std::chrono::seconds(10);
constexpr auto kOrderTime = std::chrono::milliseconds(500);
constexpr int kOrderPeriodMs = 50;

/// Waits for a message on the channel that satisfies the predicate.
template <class Msg>
int await(LcmBus& bus, std::string_view channel, const std::function<bool(const Msg&)>& predicate) {
  bool found = false;
  bus.subscribe(channel, adit::Delivery::queued(1000), [&](const adit::ReceivedMessage& received) {
    const auto message = adit::decode<Msg>(received.bytes);
    found = found || (message && predicate(*message));
    return message.rejection();
  });
  procman_lcm::discovery_t discovery{};
  discovery.transmitter_id = "live_sheriff";
  bus.publish(adit::channels::kPmDiscover, adit::encode(discovery));
  for (const auto end = Clock::now() + kTimeout; !found && Clock::now() < end;) bus.handle(100);
  if (!found) std::cerr << "live_sheriff: timeout\n";
  return found ? 0 : 1;
}

int await_status(LcmBus& bus, const std::vector<std::string>& arguments) {
  return await<procman_lcm::deputy_info_t>(bus, adit::channels::kPmInfo, [&](const auto& info) {
    if (info.deputy_id != arguments[1]) return false;
    for (const procman_lcm::cmd_status_t& status : info.cmds) {
      if (status.cmd.command_id != arguments[2] || (status.pid > 0) != (arguments[3] == "running"))
        continue;
      std::cout << status.pid << std::endl;
      return true;
    }
    return false;
  });
}

int await_output(LcmBus& bus, const std::vector<std::string>& arguments) {
  return await<procman_lcm::output_t>(bus, adit::channels::kPmOutput, [&](const auto& output) {
    for (int i = 0; i < output.num_commands; ++i) {
      if (output.deputy_id == arguments[1] && output.command_ids[i] == arguments[2] &&
          output.text[i].find(arguments[3]) != std::string::npos) {
        return true;
      }
    }
    return false;
  });
}

int order(LcmBus& bus, const std::vector<std::string>& arguments) {
  procman_lcm::orders_t orders{};
  orders.deputy_id = arguments[1];
  orders.sheriff_id = arguments[2];
  orders.ncmds = 1;
  orders.cmds.resize(1);
  orders.cmds[0].cmd = {};
  orders.cmds[0].cmd.command_id = arguments[3];
  orders.cmds[0].cmd.exec_str = arguments[4];
  orders.cmds[0].desired_runid = std::stoi(arguments[5]);
  orders.cmds[0].force_quit = arguments[6] == "stop" ? 1 : 0;
  for (const auto end = Clock::now() + kOrderTime; Clock::now() < end;) {
    bus.publish(adit::channels::kPmOrders, adit::encode(orders));
    bus.handle(kOrderPeriodMs);
  }
  return 0;
}

}  // namespace

int main(int argc, char** argv) {
  const std::vector<std::string> arguments(argv + 1, argv + argc);
  LcmBus bus;
  if (arguments.size() == 4 && arguments[0] == "await") return await_status(bus, arguments);
  if (arguments.size() == 4 && arguments[0] == "output") return await_output(bus, arguments);
  if (arguments.size() == 7 && arguments[0] == "order") return order(bus, arguments);
  std::cerr << "live_sheriff: await, order or output; see its source\n";
  return 2;
}

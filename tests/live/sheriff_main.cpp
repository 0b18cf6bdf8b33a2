// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
// live_sheriff: what procman's sheriff says and hears, field by field, to try the supervisor with.
//   live_sheriff await DEPUTY COMMAND running|stopped   until PM_INFO says so; prints the process
//   id live_sheriff order DEPUTY SHERIFF COMMAND EXEC RUN_ID start|stop    PM_ORDERS for half a
//   second live_sheriff output DEPUTY COMMAND TEXT             until PM_OUTPUT has the text
// Ends with 0, or with 1 where it waited in vain for ten seconds.
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

/// Until `is_it` says so of a message on the channel.
template <class Msg>
int await(LcmBus& bus, std::string_view channel, const std::function<bool(const Msg&)>& is_it) {
  bool found = false;
  bus.subscribe(channel, adit::Delivery::queued(1000), [&](const adit::ReceivedMessage& received) {
    const auto message = adit::decode<Msg>(received.bytes);
    found = found || (message && is_it(*message));
    return message.rejection();
  });
  procman_lcm::discovery_t question{};
  question.transmitter_id = "live_sheriff";
  bus.publish(adit::channels::kPmDiscover, adit::encode(question));
  for (const auto end = Clock::now() + kTimeout; !found && Clock::now() < end;) bus.handle(100);
  if (!found) std::cerr << "live_sheriff: waited in vain\n";
  return found ? 0 : 1;
}

int await_status(LcmBus& bus, const std::vector<std::string>& words) {
  return await<procman_lcm::deputy_info_t>(bus, adit::channels::kPmInfo, [&](const auto& info) {
    if (info.deputy_id != words[1]) return false;
    for (const procman_lcm::cmd_status_t& status : info.cmds) {
      if (status.cmd.command_id != words[2] || (status.pid > 0) != (words[3] == "running"))
        continue;
      std::cout << status.pid << std::endl;
      return true;
    }
    return false;
  });
}

int await_output(LcmBus& bus, const std::vector<std::string>& words) {
  return await<procman_lcm::output_t>(bus, adit::channels::kPmOutput, [&](const auto& output) {
    for (int i = 0; i < output.num_commands; ++i) {
      if (output.deputy_id == words[1] && output.command_ids[i] == words[2] &&
          output.text[i].find(words[3]) != std::string::npos) {
        return true;
      }
    }
    return false;
  });
}

int order(LcmBus& bus, const std::vector<std::string>& words) {
  procman_lcm::orders_t orders{};
  orders.deputy_id = words[1];
  orders.sheriff_id = words[2];
  orders.ncmds = 1;
  orders.cmds.resize(1);
  orders.cmds[0].cmd = {};
  orders.cmds[0].cmd.command_id = words[3];
  orders.cmds[0].cmd.exec_str = words[4];
  orders.cmds[0].desired_runid = std::stoi(words[5]);
  orders.cmds[0].force_quit = words[6] == "stop" ? 1 : 0;
  for (const auto end = Clock::now() + kOrderTime; Clock::now() < end;) {
    bus.publish(adit::channels::kPmOrders, adit::encode(orders));
    bus.handle(kOrderPeriodMs);
  }
  return 0;
}

}  // namespace

int main(int argc, char** argv) {
  const std::vector<std::string> words(argv + 1, argv + argc);
  LcmBus bus;
  if (words.size() == 4 && words[0] == "await") return await_status(bus, words);
  if (words.size() == 4 && words[0] == "output") return await_output(bus, words);
  if (words.size() == 7 && words[0] == "order") return order(bus, words);
  std::cerr << "live_sheriff: await, order or output; see its source\n";
  return 2;
}

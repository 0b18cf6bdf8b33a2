// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "procs/supervisor/supervisor_node.hpp"

#include <iostream>

#include "common/bus/channels.hpp"
#include "common/bus/typed.hpp"
#include "common/messages/procman.hpp"
#include "procs/supervisor/os/wall_time.hpp"

namespace adit {
namespace {

constexpr std::int64_t kLookUs = 20'000;  // how late an end or a line is seen
constexpr std::int64_t kOutputUs = 100'000;
constexpr std::int64_t kSecondUs = 1'000'000;
constexpr std::size_t kOrdersWaiting = 100;
constexpr std::size_t kSignsWaiting = 200;  // of life, in a second of the fastest channel

/// Decodes, converts and hands on; what `take` returns is why it refuses.
template <class Msg, class Take>
Handler reading(Take take) {
  return [take](const Received& received) -> std::string_view {
    const auto message = decode<Msg>(received.bytes);
    if (!message) return message.refusal();
    const auto value = from_message(*message);
    return value ? take(*value) : value.refusal();
  };
}

}  // namespace

SupervisorNode::SupervisorNode(Bus& bus, const Params& params) : bus_(bus), supervisor_(params) {
  listen();
  bus.every_of_world(kLookUs, [this](std::int64_t) { advance(); });
  bus.every_of_world(kOutputUs, [this](std::int64_t) { publish_output(); });
  bus.every_of_world(kSecondUs, [this](std::int64_t) { publish_each_second(); });
}

void SupervisorNode::listen() {
  bus_.subscribe(channels::kPmOrders, Delivery::queued(kOrdersWaiting),
                 reading<procman_lcm::orders_t>([this](const ProcmanOrders& orders) {
                   return supervisor_.obey(orders, steady_us());
                 }));
  bus_.subscribe(channels::kPmInfo, Delivery::queued(kOrdersWaiting),
                 reading<procman_lcm::deputy_info_t>([this](const ProcmanInfo& info) {
                   supervisor_.heard(info, steady_us());
                   return std::string_view{};
                 }));
  bus_.subscribe(channels::kPmDiscover, Delivery::latest(),
                 reading<procman_lcm::discovery_t>([this](const ProcmanDiscovery&) {
                   publish_info();
                   return std::string_view{};
                 }));
  bus_.subscribe(channels::kPmOutput, Delivery::queued(kOrdersWaiting),
                 reading<procman_lcm::output_t>([this](const ProcmanOutput& output) {
                   supervisor_.heard(output);
                   return std::string_view{};
                 }));
  listen_for_life();
}

/// A channel that no list names any more is listened to for nothing.
void SupervisorNode::listen_for_life() {
  for (const std::string& channel : supervisor_.alive_channels()) {
    if (!life_channels_.insert(channel).second) continue;
    bus_.subscribe(channel, Delivery::queued(kSignsWaiting),
                   [this, channel](const Received&) -> std::string_view {
                     supervisor_.heard(channel, steady_us());
                     return {};
                   });
  }
}

void SupervisorNode::advance() {
  const Supervisor::News news = supervisor_.advance(steady_us());
  if (news.list) listen_for_life();
  if (news.list && !supervisor_.list_failure().empty()) {
    std::cerr << "adit-supervisor: " << supervisor_.list_failure() << std::endl;
  }
  if (news.here) publish_info();
  if (news.elsewhere) publish_orders();
}

void SupervisorNode::publish_each_second() {
  supervisor_.measure(steady_us());
  publish_info();
  publish_orders();
}

void SupervisorNode::publish_info() {
  publish(bus_, channels::kPmInfo, to_message(supervisor_.info(wall_utime())));
}

void SupervisorNode::publish_orders() {
  for (const ProcmanOrders& orders : supervisor_.orders(wall_utime())) {
    publish(bus_, channels::kPmOrders, to_message(orders));
  }
}

void SupervisorNode::publish_output() {
  for (const ProcmanOutput& output : supervisor_.take_output(wall_utime())) {
    publish(bus_, channels::kPmOutput, to_message(output));
  }
}

Health SupervisorNode::health() const {
  const std::string complaint = supervisor_.complaint();
  if (complaint.empty()) return {};
  return {supervisor_.gave_up() ? Health::Level::kFault : Health::Level::kDegraded, complaint};
}

}  // namespace adit

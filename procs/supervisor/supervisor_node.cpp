// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "procs/supervisor/supervisor_node.hpp"

#include <iostream>

#include "common/bus/channels.hpp"
#include "common/bus/typed_messages.hpp"
#include "common/messages/procman.hpp"
#include "procs/supervisor/os/wall_time.hpp"

namespace adit {
namespace {

constexpr std::int64_t kPollUs = 20'000;  // maximum delay of detecting an end or output
constexpr std::int64_t kOutputUs = 100'000;
constexpr std::int64_t kSecondUs = 1'000'000;
constexpr std::size_t kOrdersQueueMax = 100;
constexpr std::size_t kLivenessQueueMax = 200;  // one second of the fastest channel

/// Decodes and converts a message and passes it to `take`, which returns a rejection or "".
template <class Msg, class Take>
Handler decoding(Take take) {
  return [take](const ReceivedMessage& received) -> std::string_view {
    const auto message = decode<Msg>(received.bytes);
    if (!message) return message.rejection();
    const auto value = from_message(*message);
    return value ? take(*value) : value.rejection();
  };
}

}  // namespace

SupervisorNode::SupervisorNode(Bus& bus, const Params& params) : bus_(bus), supervisor_(params) {
  subscribe_to_procman();
  bus.create_wall_timer(kPollUs, [this](std::int64_t) { advance(); });
  bus.create_wall_timer(kOutputUs, [this](std::int64_t) { publish_output(); });
  bus.create_wall_timer(kSecondUs, [this](std::int64_t) { publish_each_second(); });
}

void SupervisorNode::subscribe_to_procman() {
  bus_.subscribe(channels::kPmOrders, Delivery::queued(kOrdersQueueMax),
                 decoding<procman_lcm::orders_t>([this](const ProcmanOrders& orders) {
                   return supervisor_.apply_orders(orders, steady_us());
                 }));
  bus_.subscribe(channels::kPmInfo, Delivery::queued(kOrdersQueueMax),
                 decoding<procman_lcm::deputy_info_t>([this](const ProcmanInfo& info) {
                   supervisor_.on_message(info, steady_us());
                   return std::string_view{};
                 }));
  bus_.subscribe(channels::kPmDiscover, Delivery::latest(),
                 decoding<procman_lcm::discovery_t>([this](const ProcmanDiscovery&) {
                   publish_info();
                   return std::string_view{};
                 }));
  bus_.subscribe(channels::kPmOutput, Delivery::queued(kOrdersQueueMax),
                 decoding<procman_lcm::output_t>([this](const ProcmanOutput& output) {
                   supervisor_.on_message(output);
                   return std::string_view{};
                 }));
  subscribe_to_liveness();
}

/// Channels that are no longer in the list remain subscribed, without effect.
void SupervisorNode::subscribe_to_liveness() {
  for (const std::string& channel : supervisor_.liveness_channels()) {
    if (!liveness_channels_.insert(channel).second) continue;
    bus_.subscribe(channel, Delivery::queued(kLivenessQueueMax),
                   [this, channel](const ReceivedMessage&) -> std::string_view {
                     supervisor_.on_message(channel, steady_us());
                     return {};
                   });
  }
}

void SupervisorNode::advance() {
  const Supervisor::Changes changes = supervisor_.advance(steady_us());
  if (changes.list) subscribe_to_liveness();
  if (changes.list && !supervisor_.list_error().empty()) {
    std::cerr << "adit-supervisor: " << supervisor_.list_error() << std::endl;
  }
  if (changes.local) publish_info();
  if (changes.remote) publish_orders();
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
  const std::string problem = supervisor_.problem();
  if (problem.empty()) return {};
  return {supervisor_.any_process_failed() ? Health::Level::kFault : Health::Level::kDegraded,
          problem};
}

}  // namespace adit

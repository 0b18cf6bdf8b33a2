// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "procs/supervisor/supervisor_node.hpp"

#include <cstdint>
#include <random>
#include <string>

#include "common/bus/channels.hpp"
#include "common/bus/typed_messages.hpp"
#include "common/messages/procman.hpp"
#include "common/service/wall_time.hpp"
#include "common/text/message_text.hpp"

namespace adit {
namespace {

constexpr std::int64_t kPollUs = 20'000;  // maximum delay of detecting an end or output
constexpr std::int64_t kOutputUs = 100'000;
constexpr std::int64_t kSecondUs = 1'000'000;
constexpr std::size_t kOrdersQueueMax = 100;
constexpr std::size_t kLivenessQueueMax = 200;  // one second of the fastest channel

std::int64_t random_nonce() {
  std::random_device random;
  return static_cast<std::int64_t>(std::uint64_t{random()} << 31U | random() >> 1U);
}

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

SupervisorNode::SupervisorNode(Bus& bus, const Params& params)
    : bus_(bus),
      supervisor_(params),
      claim_(supervisor_.name(), random_nonce(), params.listen_s, steady_us()) {
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
                   claim_.on_message(info, steady_us());
                   supervisor_.on_message(info, steady_us());
                   return std::string_view{};
                 }));
  bus_.subscribe(channels::kPmDiscover, Delivery::queued(kOrdersQueueMax),
                 decoding<procman_lcm::discovery_t>([this](const ProcmanDiscovery& probe) {
                   claim_.on_message(probe);
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

void SupervisorNode::claim_name() {
  if (const auto probe = claim_.take_probe(wall_utime(), steady_us())) {
    publish(bus_, channels::kPmDiscover, to_message(*probe));
  }
}

void SupervisorNode::advance() {
  claim_name();
  if (!claim_.is_held(steady_us())) return;
  const Supervisor::Changes changes = supervisor_.advance(steady_us());
  if (changes.list) subscribe_to_liveness();
  if (changes.list && !supervisor_.list_error().empty()) {
    print_error("adit-supervisor", supervisor_.list_error());
  }
  if (changes.local) publish_info();
  if (changes.remote) publish_orders();
}

void SupervisorNode::publish_each_second() {
  if (!claim_.is_held(steady_us())) return;
  supervisor_.measure(steady_us());
  publish_info();
  publish_orders();
}

void SupervisorNode::publish_info() {
  if (!claim_.is_held(steady_us())) return;
  const ProcmanInfo info = supervisor_.info(wall_utime());
  claim_.published(info);
  publish(bus_, channels::kPmInfo, to_message(info));
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
  std::string problem = supervisor_.problem();
  if (problem.empty()) problem = claim_.problem(steady_us());
  if (problem.empty()) return {};
  return {supervisor_.any_process_failed() ? Health::Level::kFault : Health::Level::kDegraded,
          problem};
}

}  // namespace adit

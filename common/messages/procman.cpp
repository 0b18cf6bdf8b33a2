// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "common/messages/procman.hpp"

#include <limits>
#include <stdexcept>

#include "common/messages/fields/procman_fields.hpp"

namespace adit {
namespace {

procman_lcm::cmd_t to_message(const ProcmanCommand& command) {
  procman_lcm::cmd_t message;
  message.command_id = command.id;
  message.exec_str = command.exec;
  message.group = command.group;
  message.auto_respawn = command.auto_respawn ? 1 : 0;
  message.stop_signal = static_cast<std::int8_t>(command.stop_signal);
  message.stop_time_allowed = static_cast<float>(command.stop_time_allowed_s);
  return message;
}

procman_lcm::cmd_status_t to_message(const ProcmanStatus& status) {
  procman_lcm::cmd_status_t message;
  message.cmd = to_message(status.command);
  message.pid = status.pid;
  message.actual_runid = status.run_id;
  message.exit_code = status.wait_status;
  message.cpu_usage = static_cast<float>(status.cpu_cores);
  message.mem_vsize_bytes = status.address_bytes;
  message.mem_rss_bytes = status.memory_bytes;
  return message;
}

ProcmanCommand command_from(const procman_lcm::cmd_t& message) {
  return {message.command_id,        message.exec_str,    message.group,
          message.auto_respawn != 0, message.stop_signal, message.stop_time_allowed};
}

ProcmanStatus status_from(const procman_lcm::cmd_status_t& message) {
  return {command_from(message.cmd), message.pid,       message.actual_runid,
          message.exit_code,         message.cpu_usage, message.mem_vsize_bytes,
          message.mem_rss_bytes};
}

HostLoad load_from(const procman_lcm::deputy_info_t& message) {
  return {message.cpu_load, message.phys_mem_total_bytes, message.phys_mem_free_bytes,
          message.swap_total_bytes, message.swap_free_bytes};
}

}  // namespace

procman_lcm::deputy_info_t to_message(const ProcmanInfo& info) {
  procman_lcm::deputy_info_t message;
  message.utime = info.utime;
  message.deputy_id = info.deputy;
  message.cpu_load = static_cast<float>(info.load.cpu_share);
  message.phys_mem_total_bytes = info.load.memory_bytes;
  message.phys_mem_free_bytes = info.load.memory_free_bytes;
  message.swap_total_bytes = info.load.swap_bytes;
  message.swap_free_bytes = info.load.swap_free_bytes;
  message.ncmds = static_cast<std::int32_t>(info.commands.size());
  for (const ProcmanStatus& status : info.commands) message.cmds.push_back(to_message(status));
  return message;
}

procman_lcm::orders_t to_message(const ProcmanOrders& orders) {
  procman_lcm::orders_t message;
  message.utime = orders.utime;
  message.deputy_id = orders.deputy;
  message.sheriff_id = orders.sheriff;
  message.ncmds = static_cast<std::int32_t>(orders.orders.size());
  for (const ProcmanOrder& order : orders.orders) {
    procman_lcm::cmd_desired_t desired;
    desired.cmd = to_message(order.command);
    desired.desired_runid = order.run_id;
    desired.force_quit = order.stop ? 1 : 0;
    message.cmds.push_back(desired);
  }
  return message;
}

procman_lcm::output_t to_message(const ProcmanOutput& output) {
  if (output.texts.size() > static_cast<std::size_t>(std::numeric_limits<std::int16_t>::max())) {
    throw std::logic_error("more texts than a message of procman can count");
  }
  procman_lcm::output_t message;
  message.utime = output.utime;
  message.deputy_id = output.deputy;
  message.num_commands = static_cast<std::int16_t>(output.texts.size());
  for (const ProcmanOutput::Text& text : output.texts) {
    message.command_ids.push_back(text.id);
    message.text.push_back(text.text);
  }
  return message;
}

procman_lcm::discovery_t to_message(const ProcmanDiscovery& discovery) {
  procman_lcm::discovery_t message;
  message.utime = discovery.utime;
  message.transmitter_id = discovery.from;
  message.nonce = discovery.nonce;
  return message;
}

Result<ProcmanInfo> from_message(const procman_lcm::deputy_info_t& message) {
  if (const auto reason = implausible_field(message); !reason.empty()) return Rejected{reason};
  ProcmanInfo info{message.utime, message.deputy_id, load_from(message), {}};
  for (const procman_lcm::cmd_status_t& status : message.cmds) {
    info.commands.push_back(status_from(status));
  }
  return info;
}

Result<ProcmanOrders> from_message(const procman_lcm::orders_t& message) {
  if (const auto reason = implausible_field(message); !reason.empty()) return Rejected{reason};
  ProcmanOrders orders{message.utime, message.deputy_id, message.sheriff_id, {}};
  for (const procman_lcm::cmd_desired_t& desired : message.cmds) {
    orders.orders.push_back(
        {command_from(desired.cmd), desired.desired_runid, desired.force_quit != 0});
  }
  return orders;
}

Result<ProcmanOutput> from_message(const procman_lcm::output_t& message) {
  if (const auto reason = implausible_field(message); !reason.empty()) return Rejected{reason};
  ProcmanOutput output{message.utime, message.deputy_id, {}};
  for (std::size_t i = 0; i < message.command_ids.size(); ++i) {
    output.texts.push_back({message.command_ids[i], message.text[i]});
  }
  return output;
}

Result<ProcmanDiscovery> from_message(const procman_lcm::discovery_t& message) {
  if (const auto reason = implausible_field(message); !reason.empty()) return Rejected{reason};
  return ProcmanDiscovery{message.utime, message.transmitter_id, message.nonce};
}

}  // namespace adit

// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "procs/supervisor/procman/local_deputy.hpp"

#include <cstddef>
#include <utility>

namespace adit {

std::string_view rejection_reason(const OrderPolicy& policy, const ProcmanOrders& orders) {
  if (policy.accepts_all) return {};
  const bool accepted =
      !policy.accepted_sheriff.empty() && orders.sheriff == policy.accepted_sheriff;
  return accepted ? "" : "orders of a foreign sheriff, and accept_orders is off";
}

std::string_view rejection_reason(const ListedCommand* command, const ProcmanOrder& order) {
  if (!command) return "order for a command that is not in the list of this computer";
  const std::string& exec = order.command.exec;
  if (!exec.empty() && exec != command->exec) return "order with another command line than listed";
  return {};
}

namespace {

constexpr std::size_t kTextBytesMax = 8'000;     // of one process per call
constexpr std::size_t kOutputBytesMax = 50'000;  // of one message

}  // namespace

ProcmanStatus procman_status(const ManagedProcess& process) {
  const ListedCommand& command = process.command();
  return {{command.id, command.exec, command.group, command.auto_respawn, command.stop_signal,
           command.stop_time_allowed_s},
          process.pid(),
          process.run_id(),
          process.wait_status(),
          process.usage().cpu_cores,
          process.usage().address_bytes,
          process.usage().memory_bytes};
}

std::vector<ProcmanOutput> OutputRelay::take(const ProcessManager& process_manager,
                                             const std::string& deputy, std::int64_t utime) {
  std::vector<ProcmanOutput> outputs;
  std::size_t bytes = kOutputBytesMax;
  for (const ManagedProcess& process : process_manager.processes()) {
    std::int64_t& sent = sent_lines_[process.command().id];
    if (process.output().next() == sent) continue;
    if (process.output().next() < sent) sent = 0;  // the process was removed and added again
    const OutputLines unread = process.output().since(sent, kTextBytesMax);
    sent = unread.next;
    std::string text = text_of(unread);
    if (bytes + text.size() > kOutputBytesMax) {
      outputs.push_back({utime, deputy, {}});
      bytes = 0;
    }
    bytes += text.size();
    outputs.back().texts.push_back({process.command().id, std::move(text)});
  }
  return outputs;
}

}  // namespace adit

// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "procs/supervisor/procman/remote_deputies.hpp"

#include <limits>

namespace adit {
namespace {

constexpr std::int64_t kDeputyTimeoutUs = 5'000'000;  // five times the period of deputy_info_t

ProcmanCommand to_procman(const ListedCommand& command) {
  return {command.id,           command.exec,        command.group,
          command.auto_respawn, command.stop_signal, command.stop_time_allowed_s};
}

std::int32_t next_run_id(std::int32_t run_id) {
  return run_id == std::numeric_limits<std::int32_t>::max() ? 1 : run_id + 1;
}

}  // namespace

RemoteDeputies::RemoteDeputies(const ProcessList& list, const std::string& own) : own_deputy_(own) {
  update_list(list);
}

RemoteDeputies::Command RemoteDeputies::begin(const ListedCommand& command) {
  const double rate_hz = command.alive.value_or(LivenessSignal{}).rate_hz;
  return {command, PublishRateMonitor(rate_hz), {}, 0, Request::kNone, {}};
}

void RemoteDeputies::update_list(const ProcessList& list) {
  std::map<std::string, Command> before;
  before.swap(commands_);
  for (const ListedCommand& listed : list.commands) {
    if (listed.deputy == own_deputy_) continue;
    Command& command = commands_.emplace(listed.id, begin(listed)).first->second;
    const auto old = before.find(listed.id);
    if (old == before.end() || old->second.listed.deputy != listed.deputy) continue;
    command.status = old->second.status;
    command.received_us = old->second.received_us;
    command.request = old->second.request;
    command.order = old->second.order;
    if (command.order) command.order->command = to_procman(listed);
    if (old->second.listed.alive == listed.alive) command.rate = old->second.rate;
  }
}

void RemoteDeputies::on_message(const ProcmanInfo& info, std::int64_t now_us) {
  for (const ProcmanStatus& status : info.commands) {
    const auto found = commands_.find(status.command.id);
    if (found == commands_.end() || found->second.listed.deputy != info.deputy) continue;
    found->second.status = status;
    found->second.received_us = now_us;
  }
}

void RemoteDeputies::on_message(std::string_view channel, std::int64_t now_us) {
  for (auto& [id, command] : commands_) {
    const auto& alive = command.listed.alive;
    if (alive && alive->channel == channel) command.rate.on_message(now_us);
  }
}

/// A command that already runs continues under its run id.
void RemoteDeputies::decide(Command& command) {
  if (command.request == Request::kNone || !command.status) return;
  const bool stop = command.request == Request::kStop;
  const bool keeps_run = stop || (command.request == Request::kRun && command.status->pid > 0);
  const std::int32_t run_id = command.status->run_id;
  command.order =
      ProcmanOrder{to_procman(command.listed), keeps_run ? run_id : next_run_id(run_id), stop};
  command.request = Request::kNone;
}

std::vector<ProcmanOrders> RemoteDeputies::orders(const std::string& sheriff, std::int64_t utime) {
  std::map<std::string, ProcmanOrders> all;
  for (auto& [id, command] : commands_) {
    decide(command);
    if (!command.order) continue;
    ProcmanOrders& orders = all[command.listed.deputy];
    orders.utime = utime;
    orders.deputy = command.listed.deputy;
    orders.sheriff = sheriff;
    orders.orders.push_back(*command.order);
  }
  std::vector<ProcmanOrders> list;
  for (auto& [deputy, orders] : all) list.push_back(std::move(orders));
  return list;
}

std::optional<ProcmanStatus> RemoteDeputies::status(const std::string& id,
                                                    std::int64_t now_us) const {
  const Command& command = commands_.at(id);
  if (now_us - command.received_us > kDeputyTimeoutUs) return std::nullopt;
  return command.status;
}

ProcessState RemoteDeputies::process_state(const std::string& id, std::int64_t now_us) const {
  const Command& command = commands_.at(id);
  const auto status = this->status(id, now_us);
  if (!status || command.request != Request::kNone) return ProcessState::kChanging;
  const bool runs = status->pid > 0;
  const auto& order = command.order;
  if (order && (order->stop ? runs : status->run_id != order->run_id))
    return ProcessState::kChanging;
  if (!runs) return ProcessState::kStopped;
  const bool is_alive = !command.listed.alive || command.rate.is_met(now_us);
  return is_alive ? ProcessState::kRunning : ProcessState::kChanging;
}

bool RemoteDeputies::is_ending(const std::string& id, std::int64_t now_us) const {
  const auto status = this->status(id, now_us);
  if (!status || status->pid <= 0) return false;
  const Command& command = commands_.at(id);
  if (command.request == Request::kStop || command.request == Request::kRestart) return true;
  return command.order && (command.order->stop || command.order->run_id != status->run_id);
}

void RemoteOutput::on_message(const ProcmanOutput& output, const ProcessList& list,
                              const std::string& own) {
  if (output.deputy == own) return;
  for (const ProcmanOutput::Text& text : output.texts) {
    const ListedCommand* const command = list.find(text.id);
    if (command && command->deputy == output.deputy) logs_[text.id].add(text.text);
  }
}

const OutputLog* RemoteOutput::find(const std::string& id) const {
  const auto found = logs_.find(id);
  return found == logs_.end() ? nullptr : &found->second;
}

}  // namespace adit

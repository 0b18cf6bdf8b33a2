// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "procs/supervisor/orders/remote_deputies.hpp"

#include <limits>

namespace adit {
namespace {

constexpr std::int64_t kSilenceUs = 5'000'000;  // five times as long as a deputy is ever silent

ProcmanCommand as_procman(const ListedCommand& command) {
  return {command.id,           command.exec,        command.group,
          command.auto_respawn, command.stop_signal, command.stop_time_allowed_s};
}

std::int32_t another(std::int32_t run_id) {
  return run_id == std::numeric_limits<std::int32_t>::max() ? 1 : run_id + 1;
}

}  // namespace

RemoteDeputies::RemoteDeputies(const ProcessList& list, const std::string& own) : own_(own) {
  relist(list);
}

RemoteDeputies::Command RemoteDeputies::begin(const ListedCommand& command) {
  const double rate_hz = command.alive.value_or(AliveSign{}).rate_hz;
  return {command, PublishRate(rate_hz), {}, 0, Wish::kNone, {}};
}

void RemoteDeputies::relist(const ProcessList& list) {
  std::map<std::string, Command> before;
  before.swap(commands_);
  for (const ListedCommand& listed : list.commands) {
    if (listed.deputy == own_) continue;
    Command& command = commands_.emplace(listed.id, begin(listed)).first->second;
    const auto old = before.find(listed.id);
    if (old == before.end() || old->second.listed.deputy != listed.deputy) continue;
    command.status = old->second.status;
    command.heard_us = old->second.heard_us;
    command.wish = old->second.wish;
    command.order = old->second.order;
    if (command.order) command.order->command = as_procman(listed);
    if (old->second.listed.alive == listed.alive) command.rate = old->second.rate;
  }
}

void RemoteDeputies::heard(const ProcmanInfo& info, std::int64_t now_us) {
  for (const ProcmanStatus& status : info.commands) {
    const auto found = commands_.find(status.command.id);
    if (found == commands_.end() || found->second.listed.deputy != info.deputy) continue;
    found->second.status = status;
    found->second.heard_us = now_us;
  }
}

void RemoteDeputies::heard(std::string_view channel, std::int64_t now_us) {
  for (auto& [id, command] : commands_) {
    const auto& alive = command.listed.alive;
    if (alive && alive->channel == channel) command.rate.heard(now_us);
  }
}

/// A command that runs already is left to run, under the number that it has.
void RemoteDeputies::decide(Command& command) {
  if (command.wish == Wish::kNone || !command.status) return;
  const bool stop = command.wish == Wish::kStop;
  const bool keeps = stop || (command.wish == Wish::kRun && command.status->pid > 0);
  const std::int32_t run_id = command.status->run_id;
  command.order = ProcmanOrder{as_procman(command.listed), keeps ? run_id : another(run_id), stop};
  command.wish = Wish::kNone;
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
  if (now_us - command.heard_us > kSilenceUs) return std::nullopt;
  return command.status;
}

Standing RemoteDeputies::standing(const std::string& id, std::int64_t now_us) const {
  const Command& command = commands_.at(id);
  const auto status = this->status(id, now_us);
  if (!status || command.wish != Wish::kNone) return Standing::kBetween;
  const bool runs = status->pid > 0;
  const auto& order = command.order;
  if (order && (order->stop ? runs : status->run_id != order->run_id)) return Standing::kBetween;
  if (!runs) return Standing::kStopped;
  const bool shows_life = !command.listed.alive || command.rate.is_kept(now_us);
  return shows_life ? Standing::kWorking : Standing::kBetween;
}

bool RemoteDeputies::is_ending(const std::string& id, std::int64_t now_us) const {
  const auto status = this->status(id, now_us);
  if (!status || status->pid <= 0) return false;
  const Command& command = commands_.at(id);
  if (command.wish == Wish::kStop || command.wish == Wish::kRunAnew) return true;
  return command.order && (command.order->stop || command.order->run_id != status->run_id);
}

}  // namespace adit

// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "procs/supervisor/supervisor.hpp"

#include <map>
#include <stdexcept>
#include <utility>

#include "procs/supervisor/fleet_rows.hpp"
#include "procs/supervisor/keeping/list_change.hpp"
#include "procs/supervisor/logs_answer.hpp"
#include "procs/supervisor/os/wall_time.hpp"

namespace adit {
namespace {

ProcessList read_again(const SupervisorParams& params) try {
  return make_site(params).list;
} catch (const std::runtime_error& refusal) {
  throw std::runtime_error(std::string(refusal.what()) + "; the old process list stays");
}

OrderPolicy policy_of(const SupervisorParams& params) {
  return {params.role == "deputy" ? params.in_charge : "", params.accept_orders};
}

}  // namespace

Supervisor::Supervisor(const SupervisorParams& params)
    : params_(params),
      site_(make_site(params)),
      policy_(policy_of(params)),
      fleet_(site_, params.restart),
      load_(host_.measure()),
      terminals_(site_.socket) {
  if (!params.start_script.empty()) begin_script(params.start_script);
  service_manager_.tell("READY=1");
}

Supervisor::News Supervisor::advance(std::int64_t now_us) {
  terminals_.poll([this](const std::vector<std::string>& words) { return answer(words); });
  if (reload_signal_.came()) reload_by_signal(now_us);
  if (script_.advance(fleet_, now_us)) news_.elsewhere = true;
  if (fleet_.advance(now_us)) news_.here = true;
  return std::exchange(news_, {});
}

/// Nobody waits for an answer: what is wrong shows in the heartbeat.
void Supervisor::reload_by_signal(std::int64_t now_us) try {
  reload(now_us);
} catch (const std::runtime_error& refusal) {
  list_failure_ = refusal.what();
}

/// A script knows its list by heart, so it cannot go on by another.
std::string Supervisor::reload(std::int64_t now_us) {
  news_.list = true;
  ProcessList list = read_again(params_);
  list_failure_.clear();
  const ListChange change = change_between(site_.list, list);
  std::string text = text_of(change);
  if (script_.end("was ended by a new process list")) text += script_.failure() + "\n";
  std::swap(site_.list, list);
  fleet_.relist(list, now_us);
  news_.here = true;
  news_.elsewhere = true;
  return text;
}

void Supervisor::measure(std::int64_t now_us) {
  fleet_.keeper().measure(now_us);
  load_ = host_.measure();
  service_manager_.tell("WATCHDOG=1\nSTATUS=" + count_of_running(fleet_.keeper()));
}

void Supervisor::begin_script(const std::string& name) {
  script_.begin(name, site_.list, params_.script_timeout_s);
}

void Supervisor::change(const ScriptChange& change, std::int64_t now_us) {
  fleet_.change(change, now_us);
  news_.elsewhere = true;
}

std::string_view Supervisor::obey(const ProcmanOrders& orders, std::int64_t now_us) {
  if (orders.deputy != site_.deputy) return {};
  std::string_view refusal = reason_to_refuse(policy_, orders);
  if (!refusal.empty()) return refusal;
  for (const ProcmanOrder& order : orders.orders) {
    KeptProcess* const process = fleet_.keeper().find(order.command.id);
    const ListedCommand* const listed = site_.list.find(order.command.id);
    const auto reason = reason_to_refuse(process ? listed : nullptr, order);
    if (reason.empty()) {
      process->order(order.run_id, order.stop, now_us);
    } else {
      refusal = reason;
    }
  }
  return refusal;
}

ProcmanInfo Supervisor::info(std::int64_t utime) const {
  ProcmanInfo info{utime, site_.deputy, load_, {}};
  for (const KeptProcess& process : fleet_.keeper().processes()) {
    info.commands.push_back(procman_status(process));
  }
  return info;
}

std::vector<ProcmanOrders> Supervisor::orders(std::int64_t utime) {
  if (!site_.in_charge) return {};
  return fleet_.remotes().orders(site_.deputy, utime);
}

std::set<std::string> Supervisor::alive_channels() const {
  std::set<std::string> channels;
  for (const ListedCommand& command : site_.list.commands) {
    if (command.alive) channels.insert(command.alive->channel);
  }
  return channels;
}

std::string Supervisor::complaint() const {
  std::string complaint = complaint_about(fleet_.keeper());
  if (!complaint.empty()) return complaint;
  return list_failure_.empty() ? script_.failure() : list_failure_;
}

TerminalAnswer Supervisor::answer(const std::vector<std::string>& words) {
  static const std::map<std::string, ScriptAction::Kind> kChanges{
      {"start", ScriptAction::Kind::kStart},
      {"stop", ScriptAction::Kind::kStop},
      {"restart", ScriptAction::Kind::kRestart}};
  const std::string& verb = words.front();
  const std::vector<std::string> names(words.begin() + 1, words.end());
  if (verb == "ps") return {rows_of(fleet_, steady_us())};
  if ((verb == "logs" || verb == "follow") && names.size() == 1) {
    return logs_answer(fleet_, names.front(), verb == "follow");
  }
  if (verb == "script" && names.size() == 1) {
    begin_script(names.front());
    return {};
  }
  if (verb == "reload" && names.empty()) return {reload(steady_us())};
  const auto found = kChanges.find(verb);
  if (found == kChanges.end()) throw std::invalid_argument("unknown request \"" + verb + "\"");
  change({found->second, names.empty() ? site_.list.ids_of({}) : names}, steady_us());
  return {};
}

}  // namespace adit

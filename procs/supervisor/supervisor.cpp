// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "procs/supervisor/supervisor.hpp"

#include <map>
#include <stdexcept>
#include <utility>

#include "common/process_list/process_list.hpp"
#include "common/service/wall_time.hpp"
#include "common/text/message_text.hpp"
#include "procs/supervisor/fleet_status.hpp"

namespace adit {
namespace {

ProcessList reread_list(const SupervisorParams& params) try {
  return make_setup(params).list;
} catch (const std::runtime_error& rejection) {
  throw std::runtime_error(std::string(rejection.what()) + "; the old process list stays in use");
}

OrderPolicy policy_of(const SupervisorParams& params) {
  return {params.role == "deputy" ? params.in_charge : "", params.accept_orders};
}

}  // namespace

Supervisor::Supervisor(const SupervisorParams& params)
    : params_(params),
      setup_(make_setup(params)),
      policy_(policy_of(params)),
      fleet_(setup_, params.restart),
      load_(host_.measure()),
      control_server_(setup_.socket) {
  if (!params.start_script.empty()) begin_script(params.start_script);
  service_manager_.notify("READY=1");
}

Supervisor::Changes Supervisor::advance(std::int64_t now_us) {
  control_server_.poll(
      [this](const std::vector<std::string>& fields) { return handle_request(fields); });
  if (reload_signal_.received()) reload_by_signal(now_us);
  if (script_.advance(fleet_, now_us)) changes_.remote = true;
  if (fleet_.advance(now_us)) changes_.local = true;
  return std::exchange(changes_, {});
}

/// Without a client that receives a response, an error is reported in the heartbeat.
void Supervisor::reload_by_signal(std::int64_t now_us) try {
  reload(now_us);
} catch (const std::runtime_error& rejection) {
  list_error_ = rejection.what();
}

/// A running script refers to actions of the old list, so it is aborted.
std::string Supervisor::reload(std::int64_t now_us) {
  changes_.list = true;
  ProcessList list = reread_list(params_);
  list_error_.clear();
  const ProcessListDiff change = diff(setup_.list, list);
  std::string text = text_of(change);
  if (script_.abort("was aborted by a new process list")) text += script_.failure() + "\n";
  std::swap(setup_.list, list);
  fleet_.update_list(list, now_us);
  changes_.local = true;
  changes_.remote = true;
  return text;
}

void Supervisor::measure(std::int64_t now_us) {
  fleet_.process_manager().measure(now_us);
  load_ = host_.measure();
  service_manager_.notify("WATCHDOG=1\nSTATUS=" + running_count_text(fleet_.process_manager()));
}

void Supervisor::begin_script(const std::string& name) {
  script_.begin(name, setup_.list, params_.script_timeout_s);
}

void Supervisor::change(const ScriptChange& change, std::int64_t now_us) {
  fleet_.change(change, now_us);
  changes_.remote = true;
}

std::string_view Supervisor::apply_orders(const ProcmanOrders& orders, std::int64_t now_us) {
  if (orders.deputy != setup_.deputy) return {};
  std::string_view rejection = rejection_reason(policy_, orders);
  if (!rejection.empty()) return rejection;
  for (const ProcmanOrder& order : orders.orders) {
    ManagedProcess* const process = fleet_.process_manager().find(order.command.id);
    const ListedCommand* const listed = setup_.list.find(order.command.id);
    const auto reason = rejection_reason(process ? listed : nullptr, order);
    if (reason.empty()) {
      process->order(order.run_id, order.stop, now_us);
    } else {
      rejection = reason;
    }
  }
  return rejection;
}

ProcmanInfo Supervisor::info(std::int64_t utime) const {
  ProcmanInfo info{utime, setup_.deputy, load_, {}};
  for (const ManagedProcess& process : fleet_.process_manager().processes()) {
    info.commands.push_back(procman_status(process));
  }
  return info;
}

std::vector<ProcmanOrders> Supervisor::orders(std::int64_t utime) {
  if (!setup_.in_charge) return {};
  return fleet_.remotes().orders(setup_.deputy, utime);
}

std::set<std::string> Supervisor::liveness_channels() const {
  std::set<std::string> channels;
  for (const ListedCommand& command : setup_.list.commands) {
    if (command.alive) channels.insert(command.alive->channel);
    if (!command.answer || command.deputy != setup_.deputy) continue;
    channels.insert(command.answer->channel);
    channels.insert(command.answer->inputs.begin(), command.answer->inputs.end());
  }
  return channels;
}

std::string Supervisor::problem() const {
  std::string problem = first_problem(fleet_.process_manager());
  if (!problem.empty()) return problem;
  return list_error_.empty() ? script_.failure() : list_error_;
}

ControlResponse Supervisor::handle_request(const std::vector<std::string>& fields) {
  static const std::map<std::string, ScriptAction::Kind> kChanges{
      {"start", ScriptAction::Kind::kStart},
      {"stop", ScriptAction::Kind::kStop},
      {"restart", ScriptAction::Kind::kRestart}};
  const std::string& verb = fields.front();
  const std::vector<std::string> names(fields.begin() + 1, fields.end());
  if (verb == "ps") return {status_rows(fleet_, steady_us())};
  if ((verb == "logs" || verb == "follow") && names.size() == 1) {
    return logs_response(fleet_, names.front(), verb == "follow");
  }
  if (verb == "script" && names.size() == 1) {
    begin_script(names.front());
    return {};
  }
  if (verb == "reload" && names.empty()) return {reload(steady_us())};
  const auto found = kChanges.find(verb);
  if (found == kChanges.end()) throw std::invalid_argument("unknown request " + quote(verb, '"'));
  change({found->second, names.empty() ? setup_.list.ids_of({}) : names}, steady_us());
  return {};
}

}  // namespace adit

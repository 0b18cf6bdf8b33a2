// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "procs/supervisor/fleet.hpp"

#include <stdexcept>

#include "common/text/message_text.hpp"

namespace adit {
namespace {

using Kind = ScriptAction::Kind;

}  // namespace

Fleet::Fleet(const SupervisorSetup& setup, const RestartBackoff& backoff)
    : setup_(setup),
      process_manager_(setup.list,
                       {setup.deputy, setup.watcher, backoff, setup.log_dir, setup.log_limits}),
      remotes_(setup.list, setup.deputy) {}

void Fleet::require_change_allowed(const std::string& id) {
  const ListedCommand* const command = setup_.list.find(id);
  if (!command) throw std::invalid_argument("no process " + quote(id, '"') + " in the list");
  if (!setup_.in_charge && command->deputy != setup_.deputy) {
    throw std::invalid_argument(quote(id, '"') + " runs on " + command->deputy +
                                ", and this supervisor is not in charge");
  }
}

void Fleet::change(const ScriptChange& change, std::int64_t now_us) {
  for (const std::string& id : change.ids) require_change_allowed(id);
  for (const std::string& id : change.ids) {
    if (change.kind == Kind::kStart) {
      start(id);
    } else {
      enqueue_stop(*setup_.list.find(id), change.kind == Kind::kRestart, now_us);
    }
  }
  issue_due_stops(now_us);
}

void Fleet::enqueue_stop(const ListedCommand& command, bool and_start, std::int64_t now_us) {
  stop_sequence_.add(command, and_start, now_us);
  if (ManagedProcess* const process = process_manager_.find(command.id)) process->announce_stop();
}

void Fleet::start(const std::string& id) {
  stop_sequence_.remove(id);
  if (remotes_.has(id)) return remotes_.start(id);
  process_manager_.find(id)->start();
}

void Fleet::stop(const StopSequence::Stop& stop, std::int64_t now_us) {
  if (ManagedProcess* const process =
          process_manager_.find(stop.id)) {  // also one removed from the list
    if (stop.and_start) return process->restart(now_us);
    process->stop(now_us);
  } else if (remotes_.has(stop.id)) {
    if (stop.and_start) return remotes_.restart(stop.id);
    remotes_.stop(stop.id);
  }
}

/// Repeats until nothing is due: a stop of a process that does not run is complete immediately and
/// can make others due.
void Fleet::issue_due_stops(std::int64_t now_us) {
  const auto is_ending = [&](const std::string& id) {
    if (ManagedProcess* const process = process_manager_.find(id)) {
      return process->lifecycle().state() == LifecycleState::kStopping;
    }
    return remotes_.has(id) && remotes_.is_ending(id, now_us);
  };
  for (;;) {
    const auto due = stop_sequence_.take_due(now_us, is_ending);
    if (due.empty()) return;
    for (const StopSequence::Stop& stop : due) this->stop(stop, now_us);
  }
}

void Fleet::update_list(const ProcessList& before, std::int64_t now_us) {
  for (const ListedCommand& old : before.commands) {
    ManagedProcess* const process = process_manager_.find(old.id);
    const ListedCommand* const updated = setup_.list.find(old.id);
    if (!process || (updated && *updated == old)) continue;
    const LifecycleState state = process->lifecycle().state();
    const bool stays = updated && updated->deputy == setup_.deputy;
    // A failed process is started again, since its command has changed.
    const bool and_start =
        stays && (process->lifecycle().should_run() || state == LifecycleState::kFailed);
    if (!stays || and_start) enqueue_stop(old, and_start, now_us);
  }
  process_manager_.update_list(setup_.list);
  remotes_.update_list(setup_.list);
  issue_due_stops(now_us);
}

const OutputLog* Fleet::output(const std::string& id) {
  const ManagedProcess* const process = process_manager_.find(id);
  return process ? &process->output() : remote_output_.find(id);
}

ProcessState Fleet::process_state(const std::string& id, std::int64_t now_us) {
  if (stop_sequence_.is_pending(id)) return ProcessState::kChanging;
  const ManagedProcess* const process = process_manager_.find(id);
  if (!process) return remotes_.process_state(id, now_us);
  if (process->is_ready()) return ProcessState::kRunning;
  const LifecycleState state = process->lifecycle().state();
  const bool is_stopped = state == LifecycleState::kStopped || state == LifecycleState::kFailed;
  return is_stopped ? ProcessState::kStopped : ProcessState::kChanging;
}

void Fleet::on_message(std::string_view channel, std::int64_t now_us) {
  process_manager_.on_message(channel, now_us);
  remotes_.on_message(channel, now_us);
}

bool Fleet::advance(std::int64_t now_us) {
  issue_due_stops(now_us);
  return process_manager_.advance(now_us, [&](const std::string& id) {
    return process_state(id, now_us) == ProcessState::kRunning;
  });
}

void FleetScript::begin(const std::string& name, const ProcessList& list, double timeout_s) {
  run_.emplace(list, name, timeout_s);
  failure_.clear();
}

bool FleetScript::advance(Fleet& fleet, std::int64_t now_us) {
  if (!run_) return false;
  bool changed = false;
  const auto process_state_of = [&](const std::string& id) {
    return fleet.process_state(id, now_us);
  };
  try {
    while (const auto change = run_->advance(now_us, process_state_of)) {
      fleet.change(*change, now_us);
      changed = true;
    }
    if (!run_->is_finished()) return changed;
    failure_ = run_->failure();
  } catch (const std::invalid_argument& rejection) {
    failure_ = "script " + quote(run_->name(), '"') + ": " + rejection.what();
  }
  run_.reset();
  return changed;
}

bool FleetScript::abort(const std::string& reason) {
  if (!run_) return false;
  failure_ = "script " + quote(run_->name(), '"') + " " + reason;
  run_.reset();
  return true;
}

}  // namespace adit

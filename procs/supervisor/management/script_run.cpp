// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "procs/supervisor/management/script_run.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "common/text/message_text.hpp"

namespace adit {
namespace {

using Kind = ScriptAction::Kind;

bool is_change(const ScriptAction& action) {
  return action.kind == Kind::kStart || action.kind == Kind::kStop || action.kind == Kind::kRestart;
}

}  // namespace

ScriptRun::ScriptRun(const ProcessList& list, const std::string& name, double timeout_s)
    : list_(list), name_(name), timeout_s_(timeout_s) {
  const ProcessScript* const script = list.find_script(name);
  if (!script) throw std::invalid_argument("no script " + quote(name, '"'));
  calls_.push_back({script});
}

std::optional<ScriptChange> ScriptRun::advance(std::int64_t now_us,
                                               const ProcessStateOf& process_state_of) {
  while (!calls_.empty() && !is_waiting(now_us, process_state_of)) {
    Call& call = calls_.back();
    if (call.next == call.script->actions.size()) {
      calls_.pop_back();
      continue;
    }
    const ScriptAction& action = call.script->actions[call.next++];
    if (action.kind == Kind::kRunScript) {
      calls_.push_back({list_.find_script(action.script)});
      continue;
    }
    begin_wait(action, now_us);
    if (is_change(action)) return ScriptChange{action.kind, list_.ids_of(action.target)};
  }
  return std::nullopt;
}

void ScriptRun::begin_wait(const ScriptAction& action, std::int64_t now_us) {
  const bool is_time = action.kind == Kind::kWaitTime;
  if (!is_time && action.awaited == AwaitedStatus::kNone) return;
  waiting_ = &action;
  const double wait_s = is_time ? action.wait_ms * 1e-3 : action.timeout_s.value_or(timeout_s_);
  wait_end_us_ = now_us + std::llround(wait_s * 1e6);
}

/// A wait that times out ends the script with a failure.
bool ScriptRun::is_waiting(std::int64_t now_us, const ProcessStateOf& process_state_of) {
  if (!waiting_) return false;
  const bool within_timeout = now_us < wait_end_us_;
  if (waiting_->kind == Kind::kWaitTime) {
    if (!within_timeout) waiting_ = nullptr;
    return within_timeout;
  }
  const bool running = waiting_->awaited == AwaitedStatus::kRunning;
  const ProcessState awaited = running ? ProcessState::kRunning : ProcessState::kStopped;
  const std::vector<std::string> ids = list_.ids_of(waiting_->target);
  const auto pending =
      std::ranges::find_if(ids, [&](const auto& id) { return process_state_of(id) != awaited; });
  if (pending != ids.end() && within_timeout) return true;
  waiting_ = nullptr;
  if (pending == ids.end()) return false;
  failure_ = "script " + quote(name_, '"') + " timed out waiting for " + quote(*pending, '"') +
             " to be " + (running ? "running" : "stopped");
  calls_.clear();
  return true;
}

}  // namespace adit

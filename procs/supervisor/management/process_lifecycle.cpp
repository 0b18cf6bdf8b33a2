// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "procs/supervisor/management/process_lifecycle.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace adit {
namespace {

constexpr double kSecondUs = 1e6;
constexpr std::int64_t kKillPeriodUs = 1'000'000;
constexpr int kDoublingsMax = 30;

std::int64_t us(double seconds) { return std::llround(seconds * kSecondUs); }

std::string seconds_text(double seconds) {
  std::string text = std::to_string(seconds);
  text.resize(text.find('.') + 2);
  return text + " s";
}

}  // namespace

std::string_view name_of(LifecycleState state) {
  switch (state) {
    case LifecycleState::kStopped:
      return "stopped";
    case LifecycleState::kWaiting:
      return "waiting";
    case LifecycleState::kStarting:
      return "starting";
    case LifecycleState::kRunning:
      return "running";
    case LifecycleState::kStopping:
      return "stopping";
    case LifecycleState::kBackoff:
      return "pausing";
    case LifecycleState::kFailed:
      return "failed";
  }
  return "";
}

bool ProcessLifecycle::runs() const {
  return state_ == LifecycleState::kStarting || state_ == LifecycleState::kRunning ||
         state_ == LifecycleState::kStopping;
}

void ProcessLifecycle::request_start() {
  if (state_ == LifecycleState::kStopping && !should_run_) restart_pending_ = true;
  should_run_ = true;
  if (runs() || state_ == LifecycleState::kWaiting) return;
  restarts_ = 0;
  error_.clear();
  state_ = LifecycleState::kWaiting;
}

void ProcessLifecycle::request_stop(std::int64_t now_us) {
  should_run_ = false;
  restart_pending_ = false;
  if (!runs()) {
    state_ = LifecycleState::kStopped;
  } else if (state_ != LifecycleState::kStopping) {
    begin_stop(now_us, "");
  }
}

void ProcessLifecycle::request_restart(std::int64_t now_us) {
  if (!runs()) return request_start();
  should_run_ = true;
  restart_pending_ = true;
  if (state_ != LifecycleState::kStopping) begin_stop(now_us, "");
}

void ProcessLifecycle::begin_stop(std::int64_t now_us, const std::string& reason) {
  state_ = LifecycleState::kStopping;
  since_us_ = now_us;
  stop_requested_ = false;
  next_kill_us_ = now_us + us(rules_.stop_time_allowed_s);
  error_ = reason;
}

ProcessLifecycle::Act ProcessLifecycle::advance(std::int64_t now_us, bool dependencies_ready,
                                                bool publishes, Answers answers) {
  if (state_ == LifecycleState::kBackoff && now_us - since_us_ >= backoff_us()) {
    state_ = LifecycleState::kWaiting;
  }
  switch (state_) {
    case LifecycleState::kWaiting:
      return dependencies_ready ? Act::kStart : Act::kNothing;
    case LifecycleState::kStarting:
      return check_start(now_us, publishes);
    case LifecycleState::kRunning:
      return check_running(now_us, publishes, answers);
    case LifecycleState::kStopping:
      return enforce_stop(now_us);
    default:
      return Act::kNothing;
  }
}

ProcessLifecycle::Act ProcessLifecycle::check_start(std::int64_t now_us, bool publishes) {
  if (publishes || !rules_.requires_liveness) {
    state_ = LifecycleState::kRunning;
  } else if (now_us - since_us_ >= us(rules_.start_timeout_s)) {
    begin_stop(now_us,
               "did not reach its publish rate within " + seconds_text(rules_.start_timeout_s));
    return enforce_stop(now_us);
  }
  return Act::kNothing;
}

ProcessLifecycle::Act ProcessLifecycle::check_running(std::int64_t now_us, bool publishes,
                                                      Answers answers) {
  if (rules_.requires_liveness && !publishes) {
    begin_stop(now_us, "publish rate too low");
    return enforce_stop(now_us);
  }
  if (answers == Answers::kMissing) {
    begin_stop(now_us, rules_.ignored_input);
    return enforce_stop(now_us);
  }
  if (answers == Answers::kGiven && now_us - since_us_ >= us(rules_.backoff.stable_time_s)) {
    restarts_ = 0;
    error_.clear();
  }
  return Act::kNothing;
}

ProcessLifecycle::Act ProcessLifecycle::enforce_stop(std::int64_t now_us) {
  if (now_us >= next_kill_us_) {
    next_kill_us_ = now_us + kKillPeriodUs;
    stop_requested_ = true;
    return Act::kKill;
  }
  if (stop_requested_) return Act::kNothing;
  stop_requested_ = true;
  return Act::kRequestStop;
}

void ProcessLifecycle::started(std::int64_t now_us) {
  since_us_ = now_us;
  state_ = rules_.requires_liveness ? LifecycleState::kStarting : LifecycleState::kRunning;
}

void ProcessLifecycle::start_failed(std::int64_t now_us, const std::string& reason) {
  error_ = reason;
  fail_or_back_off(now_us);
}

void ProcessLifecycle::ended(std::int64_t now_us, const std::string& how, bool succeeded) {
  const bool by_itself = state_ != LifecycleState::kStopping;
  if (by_itself) error_ = succeeded ? "" : how;
  if (std::exchange(restart_pending_, false)) {
    restarts_ = 0;
    state_ = LifecycleState::kWaiting;
  } else if (!should_run_) {
    state_ = LifecycleState::kStopped;
  } else if (by_itself && succeeded && !rules_.auto_respawn) {
    should_run_ = false;
    state_ = LifecycleState::kStopped;
  } else {
    if (error_.empty()) error_ = how;
    fail_or_back_off(now_us);
  }
}

void ProcessLifecycle::fail_or_back_off(std::int64_t now_us) {
  since_us_ = now_us;
  const bool may_restart =
      rules_.auto_respawn && restarts_ < rules_.restart_limit.value_or(restarts_ + 1);
  state_ = may_restart ? LifecycleState::kBackoff : LifecycleState::kFailed;
  should_run_ = may_restart;
  if (!may_restart) return;
  ++restarts_;
  ++total_restarts_;
}

std::int64_t ProcessLifecycle::backoff_us() const {
  const int doublings = std::clamp(restarts_ - 1, 0, kDoublingsMax);
  return us(
      std::min(rules_.backoff.delay_s * std::ldexp(1.0, doublings), rules_.backoff.delay_max_s));
}

}  // namespace adit

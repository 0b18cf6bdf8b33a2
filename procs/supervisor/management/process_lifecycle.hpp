// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

#include "common/config/bounds.hpp"

namespace adit {

/// How long to wait before a process that ended is started again: twice as long each time, until it
/// has run well for a while.
struct RestartBackoff {
  double delay_s = 0.25;
  double delay_max_s = 10.0;
  double stable_time_s = 10.0;  ///< after that the past is forgotten

  template <class V>
  void visit(V& v) {
    v("delay_s", delay_s, above(0.0));
    v("delay_max_s", delay_max_s, above(0.0));
    v("stable_time_s", stable_time_s, at_least(0.0));
  }
};

struct LifecycleRules {
  bool auto_respawn = false;
  double stop_time_allowed_s = 7.0;
  std::optional<int> restart_limit = {};
  bool requires_liveness = false;  ///< whether it works only while it publishes
  double start_timeout_s = 10.0;
  RestartBackoff backoff = {};
};

enum class LifecycleState {
  kStopped,   ///< nobody wants it to run, or it ended well
  kWaiting,   ///< for what it depends on
  kStarting,  ///< it runs, and has not shown life yet
  kRunning,
  kStopping,
  kBackoff,  ///< until it is started again
  kFailed,   ///< given up
};

/// "stopped", "waiting", "starting", "running", "stopping", "pausing", "failed".
std::string_view name_of(LifecycleState state);

/// The life of one process that is kept running: what is to be done to it, and when. Knows no clock
/// and no process: times are given, in µs of a clock that is never put back.
///
/// A process that ends, cannot be started, does not show life in time or no longer publishes is
/// started again, if it is to be (auto_respawn), after a pause; at most restart_limit times in
/// succession. One that is told to stop and does not is killed, by our own timer.
class ProcessLifecycle {
 public:
  enum class Act { kNothing, kStart, kRequestStop, kKill };

  explicit ProcessLifecycle(const LifecycleRules& rules) : rules_(rules) {}

  /// From now on; what it is on its way to is not changed.
  void set_rules(const LifecycleRules& rules) { rules_ = rules; }

  void request_start();
  void request_stop(std::int64_t now_us);
  void request_restart(std::int64_t now_us);

  /// What to do now. After kStart, one of `started` and `start_failed` is to follow.
  Act advance(std::int64_t now_us, bool dependencies_ready, bool publishes);

  void started(std::int64_t now_us);
  void start_failed(std::int64_t now_us, const std::string& why);
  /// The process and all that it started are gone. `well`: by itself, with exit code 0.
  void ended(std::int64_t now_us, const std::string& how, bool succeeded);

  [[nodiscard]] LifecycleState state() const { return state_; }
  /// Whether there is a process.
  [[nodiscard]] bool runs() const;
  /// Whether somebody wants it to run.
  [[nodiscard]] bool should_run() const { return should_run_; }
  /// In succession, without a good time between.
  [[nodiscard]] int restarts() const { return restarts_; }
  /// Why it last ended or is being stopped, where nobody asked for that; one clause.
  [[nodiscard]] const std::string& error() const { return error_; }

 private:
  void begin_stop(std::int64_t now_us, const std::string& why);
  void fail_or_back_off(std::int64_t now_us);
  Act check_start(std::int64_t now_us, bool publishes);
  Act check_running(std::int64_t now_us, bool publishes);
  Act enforce_stop(std::int64_t now_us);
  [[nodiscard]] std::int64_t backoff_us() const;

  LifecycleRules rules_;
  LifecycleState state_ = LifecycleState::kStopped;
  bool should_run_ = false;
  bool restart_pending_ = false;  // to be started as soon as it is gone
  bool stop_requested_ = false;   // it was told to stop
  int restarts_ = 0;
  std::int64_t since_us_ = 0;  // of the state
  std::int64_t next_kill_us_ = 0;
  std::string error_;
};

}  // namespace adit

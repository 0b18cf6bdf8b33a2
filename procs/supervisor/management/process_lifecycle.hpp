// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

#include "common/config/bounds.hpp"

namespace adit {

/// Exponential backoff of restarts: the delay doubles with every restart, up to a maximum, and is
/// reset after a stable run.
struct RestartBackoff {
  double delay_s = 0.25;
  double delay_max_s = 10.0;
  double stable_time_s = 10.0;  ///< run time that resets delay and restart count

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
  bool requires_liveness = false;  ///< running only while it publishes at its rate
  double start_timeout_s = 10.0;
  RestartBackoff backoff = {};
  std::string ignored_input = {};  ///< what Answers::kMissing means, one clause
};

enum class LifecycleState {
  kStopped,   ///< not requested to run, or ended successfully
  kWaiting,   ///< for its dependencies
  kStarting,  ///< started, not alive yet
  kRunning,
  kStopping,
  kBackoff,  ///< delay before the next restart
  kFailed,   ///< no further restarts
};

/// "stopped", "waiting", "starting", "running", "stopping", "pausing", "failed".
std::string_view name_of(LifecycleState state);

/// Whether a process answers its input.
enum class Answers {
  kGiven,    ///< or nothing to answer
  kAwaited,  ///< not yet
  kMissing,  ///< it ignores its input
};

/// State machine of one managed process: decides when to start, stop and kill it. Pure logic: times
/// are passed in, in µs of a monotonic clock.
///
/// A process that ends, cannot be started, is not alive in time, no longer publishes or ignores its
/// input is restarted after a backoff delay if auto_respawn is set, at most restart_limit times in
/// succession. A
/// process that does not stop within stop_time_allowed_s is killed.
class ProcessLifecycle {
 public:
  enum class Act { kNothing, kStart, kRequestStop, kKill };

  explicit ProcessLifecycle(const LifecycleRules& rules) : rules_(rules) {}

  /// Applies to future transitions; the current state and its deadlines are not changed.
  void set_rules(const LifecycleRules& rules) { rules_ = rules; }

  void request_start();
  void request_stop(std::int64_t now_us);
  void request_restart(std::int64_t now_us);

  /// Returns the action to execute now. After kStart, `started` or `start_failed` must be called.
  Act advance(std::int64_t now_us, bool dependencies_ready, bool publishes,
              Answers answers = Answers::kGiven);

  void started(std::int64_t now_us);
  void start_failed(std::int64_t now_us, const std::string& reason);
  /// The process and all its descendants have ended. `succeeded`: with exit code 0.
  void ended(std::int64_t now_us, const std::string& how, bool succeeded);

  [[nodiscard]] LifecycleState state() const { return state_; }
  /// Whether the process exists.
  [[nodiscard]] bool runs() const;
  /// Whether it is requested to run.
  [[nodiscard]] bool should_run() const { return should_run_; }
  /// Consecutive restarts without a stable run.
  [[nodiscard]] int restarts() const { return restarts_; }
  /// All restarts that were not requested, since the supervisor started.
  [[nodiscard]] int total_restarts() const { return total_restarts_; }
  /// Reason of the last end or stop that was not requested; one clause.
  [[nodiscard]] const std::string& error() const { return error_; }

 private:
  void begin_stop(std::int64_t now_us, const std::string& reason);
  void fail_or_back_off(std::int64_t now_us);
  Act check_start(std::int64_t now_us, bool publishes);
  Act check_running(std::int64_t now_us, bool publishes, Answers answers);
  Act enforce_stop(std::int64_t now_us);
  [[nodiscard]] std::int64_t backoff_us() const;

  LifecycleRules rules_;
  LifecycleState state_ = LifecycleState::kStopped;
  bool should_run_ = false;
  bool restart_pending_ = false;  // start as soon as it has ended
  bool stop_requested_ = false;   // kRequestStop or kKill was returned
  int restarts_ = 0;
  int total_restarts_ = 0;
  std::int64_t since_us_ = 0;  // start time of the state
  std::int64_t next_kill_us_ = 0;
  std::string error_;
};

}  // namespace adit

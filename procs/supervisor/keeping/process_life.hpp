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
struct RestartPace {
  double delay_s = 0.25;
  double delay_max_s = 10.0;
  double good_time_s = 10.0;  ///< after that the past is forgotten

  template <class V>
  void visit(V& v) {
    v("delay_s", delay_s, above(0.0));
    v("delay_max_s", delay_max_s, above(0.0));
    v("good_time_s", good_time_s, at_least(0.0));
  }
};

struct LifeRules {
  bool auto_respawn = false;
  double stop_time_allowed_s = 7.0;
  std::optional<int> restart_limit = {};
  bool shows_life = false;  ///< whether it works only while it publishes
  double start_timeout_s = 10.0;
  RestartPace pace = {};
};

enum class LifeState {
  kStopped,   ///< nobody wants it to run, or it ended well
  kWaiting,   ///< for what it depends on
  kStarting,  ///< it runs, and has not shown life yet
  kWorking,
  kStopping,
  kPausing,  ///< until it is started again
  kFailed,   ///< given up
};

/// "stopped", "waiting", "starting", "running", "stopping", "pausing", "failed".
std::string_view name_of(LifeState state);

/// The life of one process that is kept running: what is to be done to it, and when. Knows no clock
/// and no process: times are given, in µs of a clock that is never put back.
///
/// A process that ends, cannot be started, does not show life in time or no longer publishes is
/// started again, if it is to be (auto_respawn), after a pause; at most restart_limit times in
/// succession. One that is told to stop and does not is killed, by our own timer.
class ProcessLife {
 public:
  enum class Act { kNothing, kStart, kAskToStop, kKill };

  explicit ProcessLife(const LifeRules& rules) : rules_(rules) {}

  /// From now on; what it is on its way to is not changed.
  void go_by(const LifeRules& rules) { rules_ = rules; }

  void want_running();
  void want_stopped(std::int64_t now_us);
  void want_restart(std::int64_t now_us);

  /// What to do now. After kStart, one of `started` and `could_not_start` is to follow.
  Act advance(std::int64_t now_us, bool dependencies_work, bool publishes);

  void started(std::int64_t now_us);
  void could_not_start(std::int64_t now_us, const std::string& why);
  /// The process and all that it started are gone. `well`: by itself, with exit code 0.
  void ended(std::int64_t now_us, const std::string& how, bool well);

  [[nodiscard]] LifeState state() const { return state_; }
  /// Whether there is a process.
  [[nodiscard]] bool runs() const;
  /// Whether somebody wants it to run.
  [[nodiscard]] bool wanted() const { return wanted_; }
  /// In succession, without a good time between.
  [[nodiscard]] int restarts() const { return restarts_; }
  /// Why it last ended or is being stopped, where nobody asked for that; one clause.
  [[nodiscard]] const std::string& trouble() const { return trouble_; }

 private:
  void begin_stop(std::int64_t now_us, const std::string& why);
  void give_up_or_pause(std::int64_t now_us);
  Act watch_start(std::int64_t now_us, bool publishes);
  Act watch_work(std::int64_t now_us, bool publishes);
  Act press_stop(std::int64_t now_us);
  [[nodiscard]] std::int64_t pause_us() const;

  LifeRules rules_;
  LifeState state_ = LifeState::kStopped;
  bool wanted_ = false;
  bool again_ = false;  // to be started as soon as it is gone
  bool asked_ = false;  // it was told to stop
  int restarts_ = 0;
  std::int64_t since_us_ = 0;  // of the state
  std::int64_t next_kill_us_ = 0;
  std::string trouble_;
};

}  // namespace adit

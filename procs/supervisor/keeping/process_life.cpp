// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "procs/supervisor/keeping/process_life.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace adit {
namespace {

constexpr double kSecondUs = 1e6;
constexpr std::int64_t kKillAgainUs = 1'000'000;
constexpr int kDoublingsMax = 30;

std::int64_t us(double seconds) { return std::llround(seconds * kSecondUs); }

std::string seconds_text(double seconds) {
  std::string text = std::to_string(seconds);
  text.resize(text.find('.') + 2);
  return text + " s";
}

}  // namespace

std::string_view name_of(LifeState state) {
  switch (state) {
    case LifeState::kStopped:
      return "stopped";
    case LifeState::kWaiting:
      return "waiting";
    case LifeState::kStarting:
      return "starting";
    case LifeState::kWorking:
      return "running";
    case LifeState::kStopping:
      return "stopping";
    case LifeState::kPausing:
      return "pausing";
    case LifeState::kFailed:
      return "failed";
  }
  return "";
}

bool ProcessLife::runs() const {
  return state_ == LifeState::kStarting || state_ == LifeState::kWorking ||
         state_ == LifeState::kStopping;
}

void ProcessLife::want_running() {
  if (state_ == LifeState::kStopping && !wanted_) again_ = true;
  wanted_ = true;
  if (runs() || state_ == LifeState::kWaiting) return;
  restarts_ = 0;
  trouble_.clear();
  state_ = LifeState::kWaiting;
}

void ProcessLife::want_stopped(std::int64_t now_us) {
  wanted_ = false;
  again_ = false;
  if (!runs()) {
    state_ = LifeState::kStopped;
  } else if (state_ != LifeState::kStopping) {
    begin_stop(now_us, "");
  }
}

void ProcessLife::want_restart(std::int64_t now_us) {
  if (!runs()) return want_running();
  wanted_ = true;
  again_ = true;
  if (state_ != LifeState::kStopping) begin_stop(now_us, "");
}

void ProcessLife::begin_stop(std::int64_t now_us, const std::string& why) {
  state_ = LifeState::kStopping;
  since_us_ = now_us;
  asked_ = false;
  next_kill_us_ = now_us + us(rules_.stop_time_allowed_s);
  trouble_ = why;
}

ProcessLife::Act ProcessLife::advance(std::int64_t now_us, bool dependencies_work, bool publishes) {
  if (state_ == LifeState::kPausing && now_us - since_us_ >= pause_us()) {
    state_ = LifeState::kWaiting;
  }
  switch (state_) {
    case LifeState::kWaiting:
      return dependencies_work ? Act::kStart : Act::kNothing;
    case LifeState::kStarting:
      return watch_start(now_us, publishes);
    case LifeState::kWorking:
      return watch_work(now_us, publishes);
    case LifeState::kStopping:
      return press_stop(now_us);
    default:
      return Act::kNothing;
  }
}

ProcessLife::Act ProcessLife::watch_start(std::int64_t now_us, bool publishes) {
  if (publishes || !rules_.shows_life) {
    state_ = LifeState::kWorking;
  } else if (now_us - since_us_ >= us(rules_.start_timeout_s)) {
    begin_stop(now_us, "showed no life within " + seconds_text(rules_.start_timeout_s));
    return press_stop(now_us);
  }
  return Act::kNothing;
}

ProcessLife::Act ProcessLife::watch_work(std::int64_t now_us, bool publishes) {
  if (rules_.shows_life && !publishes) {
    begin_stop(now_us, "no longer publishes as it should");
    return press_stop(now_us);
  }
  if (now_us - since_us_ >= us(rules_.pace.good_time_s)) {
    restarts_ = 0;
    trouble_.clear();
  }
  return Act::kNothing;
}

ProcessLife::Act ProcessLife::press_stop(std::int64_t now_us) {
  if (now_us >= next_kill_us_) {
    next_kill_us_ = now_us + kKillAgainUs;
    asked_ = true;
    return Act::kKill;
  }
  if (asked_) return Act::kNothing;
  asked_ = true;
  return Act::kAskToStop;
}

void ProcessLife::started(std::int64_t now_us) {
  since_us_ = now_us;
  state_ = rules_.shows_life ? LifeState::kStarting : LifeState::kWorking;
}

void ProcessLife::could_not_start(std::int64_t now_us, const std::string& why) {
  trouble_ = why;
  give_up_or_pause(now_us);
}

void ProcessLife::ended(std::int64_t now_us, const std::string& how, bool well) {
  const bool by_itself = state_ != LifeState::kStopping;
  if (by_itself) trouble_ = well ? "" : how;
  if (std::exchange(again_, false)) {
    restarts_ = 0;
    state_ = LifeState::kWaiting;
  } else if (!wanted_) {
    state_ = LifeState::kStopped;
  } else if (by_itself && well && !rules_.auto_respawn) {
    wanted_ = false;
    state_ = LifeState::kStopped;
  } else {
    if (trouble_.empty()) trouble_ = how;
    give_up_or_pause(now_us);
  }
}

void ProcessLife::give_up_or_pause(std::int64_t now_us) {
  since_us_ = now_us;
  const bool may = rules_.auto_respawn && restarts_ < rules_.restart_limit.value_or(restarts_ + 1);
  state_ = may ? LifeState::kPausing : LifeState::kFailed;
  wanted_ = may;
  if (may) ++restarts_;
}

std::int64_t ProcessLife::pause_us() const {
  const int doublings = std::clamp(restarts_ - 1, 0, kDoublingsMax);
  return us(std::min(rules_.pace.delay_s * std::ldexp(1.0, doublings), rules_.pace.delay_max_s));
}

}  // namespace adit

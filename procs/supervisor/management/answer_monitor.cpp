// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "procs/supervisor/management/answer_monitor.hpp"

#include <algorithm>
#include <cmath>

namespace adit {
namespace {

constexpr std::int64_t kBlockedTimeMaxUs = 60'000'000;

}  // namespace

AnswerMonitor::AnswerMonitor(double timeout_s, bool late)
    : timeout_us_(std::llround(timeout_s * 1e6)), late_(late) {}

void AnswerMonitor::reset(std::int64_t now_us, double start_time_s) {
  first_input_us_.reset();
  has_answered_ = false;
  ready_us_ = now_us + std::llround(start_time_s * 1e6);
}

void AnswerMonitor::on_input(std::int64_t now_us) {
  if (late_ && !has_answered_) return;
  const bool continues = first_input_us_ && now_us - last_input_us_ < timeout_us_;
  if (!continues) {
    first_input_us_ = now_us;
    blocked_us_ = 0;
  }
  last_input_us_ = now_us;
}

void AnswerMonitor::on_answer() {
  has_answered_ = true;
  first_input_us_.reset();
}

void AnswerMonitor::add_blocked_time(std::int64_t blocked_us) {
  blocked_us_ = std::min(blocked_us_ + blocked_us, kBlockedTimeMaxUs);
}

bool AnswerMonitor::is_ignored() const {
  if (!first_input_us_) return false;
  return last_input_us_ - std::max(*first_input_us_, ready_us_) - blocked_us_ >= timeout_us_;
}

}  // namespace adit

// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "procs/supervisor/management/publish_rate_monitor.hpp"

#include <algorithm>
#include <cmath>

namespace adit {
namespace {

constexpr std::int64_t kBlockedMaxUs = 60'000'000;

double window_s(double rate_hz) { return std::max(2.0, 2.0 / rate_hz); }

}  // namespace

PublishRateMonitor::PublishRateMonitor(double rate_hz)
    : window_us_(std::llround(window_s(rate_hz) * 1e6)),
      needed_(
          static_cast<std::size_t>(std::max(1.0, std::floor(window_s(rate_hz) * rate_hz) - 1.0))) {}

void PublishRateMonitor::on_message(std::int64_t now_us) {
  times_us_.push_back(now_us);
  if (times_us_.size() > needed_) times_us_.pop_front();
  blocked_us_ = 0;
}

void PublishRateMonitor::add_blocked_time(std::int64_t now_us, std::int64_t blocked_us) {
  if (blocked_us_ >= kBlockedMaxUs) return;
  blocked_us_ += blocked_us;
  for (std::int64_t& time_us : times_us_) time_us = std::min(time_us + blocked_us, now_us);
}

void PublishRateMonitor::reset() {
  times_us_.clear();
  blocked_us_ = 0;
}

bool PublishRateMonitor::is_met(std::int64_t now_us) const {
  return times_us_.size() == needed_ && now_us - times_us_.front() <= window_us_;
}

}  // namespace adit

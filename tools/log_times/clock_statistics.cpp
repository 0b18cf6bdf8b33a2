// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "tools/log_times/clock_statistics.hpp"

#include <algorithm>
#include <vector>

#include <fmt/format.h>
#include <fmt/ranges.h>

namespace adit {

void ClockStatistics::add(std::int64_t utime, std::size_t position) {
  ++readings_;
  if (utime <= 0) {
    ++missing_;
    return;
  }
  if (!first_utime_) first_utime_ = utime;
  if (!previous_) {
    previous_ = latest_ = utime;
    return;
  }
  if (utime == *previous_) {
    ++repeated_;
  } else if (utime < latest_ - kReorderWindowUs) {
    ++set_back_;
  } else if (utime < latest_) {
    ++late_;
  } else if (utime > latest_) {
    last_change_ = Change{utime, position};
    if (!first_change_) first_change_ = last_change_;
  }
  previous_ = utime;
  // A clock that was set back continues from there; a single outdated time is followed by newer
  // ones.
  latest_ = utime < latest_ - kReorderWindowUs ? utime : std::max(latest_, utime);
}

double ClockStatistics::usable_share() const {
  return readings_ == 0 ? 0.0 : static_cast<double>(usable()) / static_cast<double>(readings_);
}

std::string ClockStatistics::defects() const {
  std::vector<std::string> texts;
  const auto add = [&](std::size_t count, const char* what) {
    if (count > 0) texts.push_back(fmt::format("{} of {} {}", count, readings_, what));
  };
  add(missing_, "are zero");
  add(repeated_, "repeat the one before");
  add(set_back_, "are long before the one before");
  return fmt::format("{}", fmt::join(texts, ", "));
}

std::optional<double> ClockStatistics::scan_period_us() const {
  if (!first_change_ || last_change_->position <= first_change_->position) return std::nullopt;
  const auto scans = static_cast<double>(last_change_->position - first_change_->position);
  return static_cast<double>(last_change_->utime - first_change_->utime) / scans;
}

}  // namespace adit

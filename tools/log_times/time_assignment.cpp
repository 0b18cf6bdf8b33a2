// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "tools/log_times/time_assignment.hpp"

#include <algorithm>
#include <cmath>

namespace adit {

std::int64_t TimeAssignment::next(std::string_view channel, const RecordedTimes& times) {
  switch (choice_.source) {
    case TimeChoice::Source::kMeasured:
      return times.measured_utime;
    case TimeChoice::Source::kLogged:
      return times.logged_utime;
    case TimeChoice::Source::kOrder:
      break;
  }
  return next_by_order(channel);
}

std::int64_t TimeAssignment::next_by_order(std::string_view channel) {
  double periods = 0.0;  // since the first scan
  if (channel == choice_.channel) {
    periods = scans_++;
    readings_since_scan_ = 0.0;
  } else {
    // Evenly spaced as far as the mean number of readings, closer and closer after it.
    const double k = ++readings_since_scan_;
    periods = scans_ - 1.0 + k / (std::max(k, choice_.readings_per_scan) + 1.0);
  }
  const auto utime = choice_.start_utime + std::llround(periods * choice_.period_us);
  return std::max<std::int64_t>(utime, 1);
}

}  // namespace adit

// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "sim/simulation/reading_queue.hpp"

#include <algorithm>

namespace adit {

void ReadingQueue::add(std::int64_t utime, Reading reading) {
  added_.emplace_back(utime, std::move(reading));
}

std::vector<Reading> ReadingQueue::take() {
  std::stable_sort(added_.begin(), added_.end(),
                   [](const auto& a, const auto& b) { return a.first < b.first; });
  std::vector<Reading> readings;
  for (auto& [utime, reading] : added_) {
    if (is_driver_reading(reading)) {
      if (is_lost(utime)) continue;
      std::int64_t& measured = utime_of(reading);
      measured += faults_.clock_ahead_us(measured);
    }
    readings.push_back(std::move(reading));
  }
  added_.clear();
  return readings;
}

bool ReadingQueue::is_lost(std::int64_t utime) {
  const double share = faults_.loss_share(utime);
  return share > 0.0 && std::uniform_real_distribution<double>()(random_) < share;
}

}  // namespace adit

// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "drivers/timing/timed_buffer.hpp"

#include <algorithm>
#include <cmath>

namespace adit {

void TimedBuffer::add(std::span<const std::uint8_t> bytes, std::int64_t arrival_us,
                      double byte_us) {
  if (bytes.empty()) return;
  byte_us_ = byte_us;
  bytes_.insert(bytes_.end(), bytes.begin(), bytes.end());
  arrivals_.push_back({bytes_.size(), arrival_us});
}

void TimedBuffer::drop(std::size_t count) {
  bytes_.erase(bytes_.begin(), bytes_.begin() + static_cast<std::ptrdiff_t>(count));
  for (Arrival& arrival : arrivals_) arrival.end -= std::min(arrival.end, count);
  while (!arrivals_.empty() && arrivals_.front().end == 0) arrivals_.pop_front();
}

void TimedBuffer::clear() {
  bytes_.clear();
  arrivals_.clear();
}

std::int64_t TimedBuffer::end_us(std::size_t end) const {
  for (const Arrival& arrival : arrivals_) {
    if (arrival.end < end) continue;
    return arrival.utime - std::llround(static_cast<double>(arrival.end - end) * byte_us_);
  }
  return 0;
}

}  // namespace adit

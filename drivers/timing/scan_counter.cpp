// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "drivers/timing/scan_counter.hpp"

#include <algorithm>
#include <cmath>

namespace adit {
namespace {

// Until then the least delay is not known, and an early scan moves the line.
constexpr std::int64_t kSettlingUs = 2'000'000;

// A scan may arrive before the line of the filter by this share of the period: the line is an
// estimate.
constexpr double kEarlyMax = 0.05;
constexpr double kEarlyMaxSettling = 0.15;

// So many scans that contradict the phase are right, and the phase is wrong.
constexpr int kContradictionsMax = 8;

}  // namespace

ScanCounter::ScanCounter(double period_us) : period_us_(period_us) {}

void ScanCounter::reset() { *this = ScanCounter(period_us_); }

std::int64_t ScanCounter::device_us(std::int64_t scan) const {
  return std::llround(static_cast<double>(scan) * period_us_);
}

/// The last scan that can have arrived by now.
std::int64_t ScanCounter::scan_at(std::int64_t arrival_us) const {
  const double early_max =
      arrival_us - first_arrival_us_ > kSettlingUs ? kEarlyMax : kEarlyMaxSettling;
  const double since_last_us = static_cast<double>(arrival_us) -
                               clock_.arrival_us(static_cast<double>(device_us(last_scan_)));
  return last_scan_ +
         static_cast<std::int64_t>(std::floor(since_last_us / period_us() + early_max));
}

std::optional<std::int64_t> ScanCounter::arrival_us(std::int64_t arrival_us,
                                                    std::int64_t scans_min) {
  if (clock_.is_empty()) {
    first_arrival_us_ = arrival_us;
    clock_.add(device_us(last_scan_), arrival_us);
    return arrival_us;
  }
  const std::int64_t scan = scan_at(arrival_us);
  if (scan < last_scan_ + scans_min) {
    const bool is_settled = arrival_us - first_arrival_us_ > kSettlingUs;
    if (is_settled && ++contradictions_ <= kContradictionsMax) return std::nullopt;
    reset();  // while it settles: the scans so far were late
    return this->arrival_us(arrival_us, scans_min);
  }
  contradictions_ = 0;
  last_scan_ = scan;
  clock_.add(device_us(scan), arrival_us);
  return std::llround(clock_.arrival_us(static_cast<double>(device_us(scan))));
}

}  // namespace adit

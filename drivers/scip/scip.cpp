// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "drivers/scip/scip.hpp"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <limits>
#include <stdexcept>

#include <fmt/format.h>

namespace adit {
namespace {

constexpr std::int64_t kTurnMs = 1 << 24;

// Half of the resolution of a stamp: the mean of what it leaves out.
constexpr double kHalfStampUs = 500.0;

}  // namespace

Scip::Scip(const ScipParams& params, LaserId laser)
    : params_(params),
      range_max_m_(laser == LaserId::kFront ? params.lasers.front.range_max_m
                                            : params.lasers.rear.range_max_m),
      session_(params) {
  if (params.angle_min_deg >= params.angle_max_deg) {
    throw std::invalid_argument(fmt::format("angle_min_deg is {}, not less than angle_max_deg, {}",
                                            params.angle_min_deg, params.angle_max_deg));
  }
  if (range_max_m_ > static_cast<double>(kNoReturnM)) {
    throw std::invalid_argument(
        fmt::format("range_max_m of the laser is {}: a reading without return is {} m; set it to "
                    "the range of the laser",
                    range_max_m_, kNoReturnM));
  }
}

void Scip::start(std::int64_t now_us) {
  clock_.reset();
  last_us_.reset();
  session_.start(now_us);
}

/// The time of the laser without overflow, by the last one that was accepted.
std::int64_t Scip::device_us(std::uint32_t time_ms) const {
  const auto since_ms = static_cast<std::int64_t>(time_ms) - last_us_.value_or(0) / 1000 % kTurnMs;
  const std::int64_t turns_ms = last_us_.value_or(0) / 1000 / kTurnMs * kTurnMs;
  const std::int64_t overflow_ms = last_us_ && since_ms < -kTurnMs / 2 ? kTurnMs : 0;
  return 1000 * (turns_ms + overflow_ms + static_cast<std::int64_t>(time_ms));
}

std::vector<LaserScan> Scip::receive(std::span<const std::uint8_t> bytes, std::int64_t now_us) {
  const auto scans = session_.receive(bytes, now_us);
  const auto times = session_.take_time_answers();
  if (!times.empty() && last_us_) {  // asked again: the laser may have been switched off
    clock_.reset();
    last_us_.reset();
  }
  for (const auto& time : times) {
    clock_.add_answer(device_us(time.time_ms) + static_cast<std::int64_t>(kHalfStampUs),
                      time.asked_us, time.answered_us);
  }
  std::vector<LaserScan> published;
  for (const auto& scan : scans) {
    if (auto stamped = laser_scan(scan)) published.push_back(std::move(*stamped));
  }
  return published;
}

/// A code tells why there is no distance. 0 is "no object in range"; the others are weak or
/// contradicting echoes, behind which is not known to be free.
float Scip::range_m(std::uint32_t raw_mm) const {
  const auto range_max_mm = static_cast<std::uint32_t>(session_.laser()->range_max_mm);
  if (raw_mm == 0 || raw_mm > range_max_mm) return kNoReturnM;
  if (raw_mm < static_cast<std::uint32_t>(session_.laser()->range_min_mm)) {
    return std::numeric_limits<float>::quiet_NaN();
  }
  return 0.001F * static_cast<float>(raw_mm);
}

/// A damaged stamp must not make those behind it too old; if all are implausible the clock of the
/// laser was set.
bool Scip::accept_stamp(std::int64_t at_us, std::int64_t arrival_us) {
  constexpr std::int64_t kOffMaxUs = 1'000'000;
  constexpr int kImplausibleMax = 5;
  if (last_us_ && ++implausible_ <= kImplausibleMax) {
    const std::int64_t off_us = at_us - *last_us_ - (arrival_us - last_arrival_us_);
    if (at_us <= *last_us_ || std::abs(off_us) > kOffMaxUs) return false;
  } else if (last_us_) {
    clock_.reset();
  }
  implausible_ = 0;
  last_us_ = at_us;
  last_arrival_us_ = arrival_us;
  return true;
}

/// Nothing for an implausible stamp.
std::optional<LaserScan> Scip::laser_scan(const ScipSession::Scan& scan) {
  const ScipParameters& laser = *session_.laser();
  const std::int64_t at_us =
      device_us(scan.readings.time_ms) + static_cast<std::int64_t>(kHalfStampUs);
  if (!accept_stamp(at_us, scan.end_us)) return std::nullopt;
  clock_.add_arrival(at_us, scan.end_us);
  const double scan_us = laser.scan_period_us() * session_.beams() / laser.steps_per_turn;
  const double delay_us = scan_us + static_cast<double>(scan.bytes) * session_.byte_us();
  LaserScan stamped{clock_.utime(at_us, delay_us) - std::llround(1000.0 * params_.delay_ms),
                    {},
                    laser.bearing_rad(scan.first_step),
                    laser.step_rad()};
  stamped.ranges_m.reserve(scan.readings.raw_mm.size());
  for (const std::uint32_t raw_mm : scan.readings.raw_mm) {
    stamped.ranges_m.push_back(range_m(raw_mm));
  }
  if (params_.upside_down) {
    std::ranges::reverse(stamped.ranges_m);
    stamped.angle_min_rad = -laser.bearing_rad(scan.first_step + session_.beams() - 1);
  }
  return stamped;
}

LaserDevice::LineCounts Scip::line_counts() const {
  return {session_.line_counts().responses, session_.line_counts().corrupt};
}

std::string Scip::problem() const {
  if (!session_.is_streaming()) return session_.status_text();
  const double range_max_m = 0.001 * session_.laser()->range_max_mm;
  if (range_max_m_ > range_max_m) {
    return fmt::format("range_max_m of the laser is {}, but it measures {} m at most: set it",
                       range_max_m_, range_max_m);
  }
  return {};
}

}  // namespace adit

// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "drivers/sick_lms2xx/sick_lms2xx.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <stdexcept>

#include <fmt/format.h>

namespace adit {
namespace {

// Status byte of a response: bits 0 to 2 the severity, bit 7 pollution of the window.
constexpr unsigned kSeverity = 0x07;
constexpr unsigned kError = 3;
constexpr unsigned kPolluted = 0x80;

void require_range_max(const SickLms2xxParams& params, LaserId laser) {
  const bool is_front = laser == LaserId::kFront;
  const double range_max_m =
      is_front ? params.lasers.front.range_max_m : params.lasers.rear.range_max_m;
  if (range_max_m <= params.laser.range_max_m()) return;
  throw std::invalid_argument(
      fmt::format("lasers.{}.range_max_m is {}: in {} this laser measures at most {:.2f} m, and "
                  "reports more where nothing returns; set it to {} or less",
                  is_front ? "front" : "rear", range_max_m, params.laser.unit,
                  params.laser.range_max_m(), std::floor(params.laser.range_max_m())));
}

}  // namespace

SickLms2xx::SickLms2xx(const SickLms2xxParams& params, LaserId laser)
    : params_(params),
      session_(params.laser),
      counter_(params.laser.scan_period_us()),
      scans_min_(std::max<std::int64_t>(
          1,
          std::llround(std::floor(params.laser.telegram_us() / params.laser.scan_period_us())))) {
  require_range_max(params, laser);
}

void SickLms2xx::start(std::int64_t now_us) {
  counter_.reset();
  session_.start(now_us);
}

/// Of scans that were read together all but the last one waited; they are at least as many periods
/// apart as the line takes for a telegram.
std::vector<std::int64_t> SickLms2xx::arrivals(const std::vector<LmsSession::Scan>& scans) const {
  std::vector<std::int64_t> arrivals(scans.size());
  const double apart_us = static_cast<double>(scans_min_) * counter_.period_us();
  for (std::size_t i = scans.size(); i-- > 0;) {
    arrivals[i] = scans[i].end_us;
    if (i + 1 == scans.size()) continue;
    arrivals[i] = std::min(arrivals[i], arrivals[i + 1] - static_cast<std::int64_t>(apart_us));
  }
  return arrivals;
}

std::vector<LaserScan> SickLms2xx::receive(std::span<const std::uint8_t> bytes,
                                           std::int64_t now_us) {
  const bool was_streaming = session_.is_streaming();
  const auto scans = session_.receive(bytes, now_us);
  if (!was_streaming && session_.is_streaming()) counter_.reset();
  const auto arrived_us = arrivals(scans);
  const double before_us =
      params_.laser.scan_duration_us() + params_.laser.telegram_us() + 1000.0 * params_.delay_ms;
  std::vector<LaserScan> stamped;
  for (std::size_t i = 0; i < scans.size(); ++i) {
    status_ = scans[i].status;
    const auto end_us = counter_.arrival_us(arrived_us[i], scans_min_);
    if (end_us) {
      stamped.push_back(laser_scan(scans[i].values, *end_us - std::llround(before_us)));
    } else {
      ++untimed_;
    }
  }
  return stamped;
}

LaserScan SickLms2xx::laser_scan(const LmsMeasuredValues& values, std::int64_t utime) const {
  constexpr double kRadPerDeg = std::numbers::pi / 180.0;
  LaserScan scan{utime, values.ranges_m(), -0.5 * params_.laser.field_of_view_deg * kRadPerDeg,
                 params_.laser.angle_step_deg * kRadPerDeg};
  if (params_.upside_down) std::ranges::reverse(scan.ranges_m);
  return scan;
}

LaserDevice::LineCounts SickLms2xx::line_counts() const {
  return {session_.line_counts().telegrams, session_.line_counts().corrupt};
}

std::string SickLms2xx::problem() const {
  if (!session_.is_streaming()) return session_.status_text();
  if ((status_ & kSeverity) >= kError) return "the laser reports an error of its hardware";
  if ((status_ & kPolluted) != 0) return "the window of the laser is dirty";
  return {};
}

}  // namespace adit

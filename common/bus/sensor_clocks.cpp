// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "common/bus/sensor_clocks.hpp"

#include <algorithm>
#include <cmath>
#include <cstdlib>

#include <fmt/format.h>

namespace adit {
namespace {

constexpr std::int64_t kGapMaxUs = 1'000'000;      // from one stamp to the next, beyond twice the
                                                   // time between their arrivals
constexpr std::int64_t kOffsetChangeUs = 500'000;  // of a channel with a gap: jitter of its arrival
constexpr std::int64_t kLastingUs = 1'000'000;     // of measurements after a jump,
constexpr int kLastingLength = 5;                  // and their number
constexpr std::int64_t kContinuesUs = 2'000'000;   // a channel that was accepted so recently

}  // namespace

bool SensorClocks::Run::is_followed_by(std::int64_t utime, std::int64_t arrival_utime) const {
  const std::int64_t elapsed_us = std::max<std::int64_t>(0, arrival_utime - last_arrival_utime);
  return length > 0 && utime > last_utime && utime - last_utime <= kGapMaxUs + 2 * elapsed_us;
}

bool SensorClocks::Run::agrees_with(std::int64_t utime, std::int64_t arrival_utime) const {
  const std::int64_t offset = utime - arrival_utime;
  return utime > last_utime && (std::abs(offset - offset_us) <= kOffsetChangeUs ||
                                std::abs(offset - on_time_offset_us) <= kOffsetChangeUs);
}

void SensorClocks::Run::add(std::int64_t utime, std::int64_t arrival_utime) {
  offset_us = utime - arrival_utime;
  if (length == 0) first_arrival_utime = arrival_utime;
  if (length == 0 || std::abs(offset_us - on_time_offset_us) <= kOffsetChangeUs) {
    on_time_offset_us = offset_us;
  }
  ++length;
  last_utime = utime;
  last_arrival_utime = arrival_utime;
}

/// A stage that was suspended receives measurements late, and a log may be played at another speed,
/// so stamps that follow each other need not agree with the time of arrival. After one that does
/// not follow they have to: a clock that was set back comes to the time of the last stamp again.
std::string_view SensorClocks::check(const std::string& channel, std::int64_t utime,
                                     std::int64_t arrival_utime) {
  auto& [accepted, rejected] = channels_[channel];
  const bool in_order = accepted.length > 0 && rejected.length == 0;
  if (in_order && utime == accepted.last_utime) return {};  // a repetition
  const bool follows = in_order && accepted.is_followed_by(utime, arrival_utime);
  if (accepted.length == 0 || follows || accepted.agrees_with(utime, arrival_utime)) {
    accepted.add(utime, arrival_utime);
    rejected = {};
    return {};
  }
  if (!rejected.is_followed_by(utime, arrival_utime)) rejected = {};
  rejected.add(utime, arrival_utime);
  const bool lasts = rejected.length >= kLastingLength &&
                     arrival_utime - rejected.first_arrival_utime >= kLastingUs;
  if (!lasts || others_continue(channel, arrival_utime)) return kNotContinuous;
  for (auto& [name, other] : channels_) other = {};  // the others are expected to follow
  channels_[channel].accepted.add(utime, arrival_utime);
  if (on_set_) on_set_();
  return {};
}

bool SensorClocks::others_continue(const std::string& channel, std::int64_t now_utime) const {
  return std::ranges::any_of(channels_, [&](const auto& entry) {
    const Run& accepted = entry.second.accepted;
    return entry.first != channel && accepted.length > 0 &&
           std::abs(now_utime - accepted.last_arrival_utime) <= kContinuesUs;
  });
}

std::string SensorClocks::fault(std::int64_t now_utime) const {
  for (const auto& [name, channel] : channels_) {
    const Run& rejected = channel.rejected;
    if (rejected.length < kLastingLength ||
        std::abs(now_utime - rejected.last_arrival_utime) > kContinuesUs) {
      continue;
    }
    const double off_s =
        1e-6 * static_cast<double>(rejected.offset_us - channel.accepted.on_time_offset_us);
    return fmt::format("the clock of {} is {:.1f} s {}", name, std::abs(off_s),
                       off_s > 0.0 ? "ahead" : "behind");
  }
  return {};
}

}  // namespace adit

// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "common/bus/sensor_clocks.hpp"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <utility>

#include <fmt/format.h>

namespace adit {
namespace {

constexpr std::int64_t kGapMaxUs = 1'000'000;      // from one stamp to the next, beyond twice the
                                                   // time between their arrivals
constexpr std::int64_t kOffsetChangeUs = 500'000;  // of a channel with a gap: jitter of its arrival
constexpr std::int64_t kLastingUs = 1'000'000;     // of measurements after a jump,
constexpr int kLastingLength = 5;                  // and their number
constexpr std::int64_t kContinuesUs = 2'000'000;   // a channel that was accepted so recently
constexpr std::int64_t kJitterUs = 20'000;         // of a stamp, beside
constexpr std::int64_t kAheadSteps = 3;            // steps that it may be ahead
constexpr int kStepsMin = 5;                       // known, to judge by them
constexpr std::int64_t kAheadReportedUs = 200'000;
constexpr std::int64_t kDriftDivisor = 1'000;  // clocks drift apart by less than 1000 ppm

/// Whether measurements that have something in common are so many, and over so long a time, that it
/// is no accident.
bool is_lasting(int length, std::int64_t first_arrival_utime, std::int64_t last_arrival_utime) {
  return length >= kLastingLength && last_arrival_utime - first_arrival_utime >= kLastingUs;
}

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

std::int64_t SensorClocks::Run::ahead_max_us() const {
  const int known = std::min(length - 1, static_cast<int>(kSteps));
  if (known < kStepsMin) return kGapMaxUs;
  std::array<std::int64_t, kSteps> sorted = steps_us;
  const auto middle = sorted.begin() + known / 2;
  std::nth_element(sorted.begin(), middle, sorted.begin() + known);
  return std::min(kGapMaxUs, kJitterUs + kAheadSteps * *middle);
}

bool SensorClocks::Run::continues(std::int64_t now_utime) const {
  return length > 0 && std::abs(now_utime - last_arrival_utime) <= kContinuesUs;
}

void SensorClocks::Run::add(std::int64_t utime, std::int64_t arrival_utime) {
  const std::int64_t previous_offset_us = std::exchange(offset_us, utime - arrival_utime);
  if (length == 0) {
    first_arrival_utime = arrival_utime;
    earliest_offset_us = offset_us;
  } else {
    steps_us[static_cast<std::size_t>(length - 1) % kSteps] = utime - last_utime;
    const std::int64_t drift_us = (arrival_utime - last_arrival_utime) / kDriftDivisor;
    // Two in succession: one that was a little ahead must not make room for the next.
    const std::int64_t lasting_offset_us = std::min(offset_us, previous_offset_us);
    earliest_offset_us = std::max(lasting_offset_us, earliest_offset_us - drift_us);
  }
  ++length;
  last_utime = utime;
  last_arrival_utime = arrival_utime;
  judge_offset(previous_offset_us);
}

/// Whether the last measurement was late. A backlog arrives at once, so that of a stage which was
/// suspended does not last.
void SensorClocks::Run::judge_offset(std::int64_t previous_offset_us) {
  if (length == 1 || std::abs(offset_us - on_time_offset_us) <= kOffsetChangeUs) {
    on_time_offset_us = offset_us;
    off_time_length = 0;
    return;
  }
  if (off_time_length == 0 || std::abs(offset_us - previous_offset_us) > kOffsetChangeUs) {
    off_time_since_utime = last_arrival_utime;
    off_time_length = 0;
  }
  ++off_time_length;
  if (!is_lasting(off_time_length, off_time_since_utime, last_arrival_utime)) return;
  on_time_offset_us = offset_us;
  earliest_offset_us = std::min(offset_us, previous_offset_us);
  off_time_length = 0;
}

/// A stage that was suspended receives measurements late, and a log may be played at another speed,
/// so stamps that follow each other need not agree with the time of arrival. After one that does
/// not follow they have to: a clock that was set back comes to the time of the last stamp again.
std::string_view SensorClocks::check(const std::string& channel, std::int64_t utime,
                                     std::int64_t arrival_utime) {
  Channel& state = channels_[channel];
  Run& accepted = state.accepted;
  Run& rejected = state.rejected;
  const bool in_order = accepted.length > 0 && rejected.length == 0;
  if (in_order && utime == accepted.last_utime) {
    ++state.repetitions;
    state.last_repetition_utime = arrival_utime;
    return state.stands() ? kNotContinuous : std::string_view{};
  }
  const bool follows = in_order && accepted.is_followed_by(utime, arrival_utime);
  const bool agrees = accepted.length > 0 && accepted.agrees_with(utime, arrival_utime);
  const bool small_step_lasts = agrees && rejected.length >= kLastingLength;
  const bool begins = accepted.length == 0 && !contradicts_others(channel, utime, arrival_utime);
  if (begins || small_step_lasts ||
      ((follows || agrees) && !is_ahead(channel, utime, arrival_utime))) {
    accepted.add(utime, arrival_utime);
    rejected = {};
    state.repetitions = 0;
    return {};
  }
  if (!rejected.is_followed_by(utime, arrival_utime)) rejected = {};
  rejected.add(utime, arrival_utime);
  const bool lasts = is_lasting(rejected.length, rejected.first_arrival_utime, arrival_utime);
  const bool others = others_continue(channel, arrival_utime);
  if (lasts && others && !contradicts_others(channel, utime, arrival_utime)) {
    // What was accepted of it before was wrong, as a first stamp may be that nothing contradicts.
    const bool was_ahead = accepted.last_utime > utime;
    accepted = std::exchange(rejected, {});
    state.repetitions = 0;
    if (was_ahead && on_set_) on_set_();
    return {};
  }
  if (!lasts || others) return kNotContinuous;
  for (auto& [name, other] : channels_) other = {};  // the others are expected to follow
  channels_[channel].accepted.add(utime, arrival_utime);
  if (on_set_) on_set_();
  return {};
}

/// Ahead of the last stamp, of the earliest arrivals and of the other channels: a log that is
/// played fast and has gaps is ahead of the first two.
bool SensorClocks::is_ahead(const std::string& channel, std::int64_t utime,
                            std::int64_t arrival_utime) const {
  const Channel& state = channels_.find(channel)->second;
  const Run& accepted = state.accepted;
  const std::int64_t ahead_max_us = accepted.ahead_max_us();
  const std::int64_t elapsed_us =
      std::max<std::int64_t>(0, arrival_utime - accepted.last_arrival_utime);
  const std::int64_t speed_max = state.rejected.length == 0 ? 2 : 1;  // of a log that is played
  if (utime - accepted.last_utime <= ahead_max_us + speed_max * elapsed_us) return false;
  const std::int64_t offset_us = utime - arrival_utime;
  if (offset_us <= accepted.earliest_offset_us + ahead_max_us) return false;
  return std::ranges::none_of(channels_, [&](const auto& entry) {
    const Run& other = entry.second.accepted;
    return entry.first != channel && other.continues(arrival_utime) &&
           offset_us <= other.offset_us + ahead_max_us;
  });
}

/// Whether one stamp is repeated as time passes.
bool SensorClocks::Channel::stands() const {
  return is_lasting(repetitions, accepted.last_arrival_utime, last_repetition_utime);
}

/// How far a channel is ahead of every other that continues; nothing without another.
std::optional<std::int64_t> SensorClocks::ahead_of_others_us(const std::string& channel,
                                                             std::int64_t now_utime) const {
  std::optional<std::int64_t> ahead_us;
  const std::int64_t own_us = channels_.find(channel)->second.accepted.earliest_offset_us;
  for (const auto& [name, other] : channels_) {
    const bool continues = other.accepted.continues(now_utime);
    if (name == channel && !continues) return std::nullopt;
    if (name == channel || !continues) continue;
    const std::int64_t difference_us = own_us - other.accepted.earliest_offset_us;
    ahead_us = std::min(ahead_us.value_or(difference_us), difference_us);
  }
  return ahead_us;
}

bool SensorClocks::others_continue(const std::string& channel, std::int64_t now_utime) const {
  return std::ranges::any_of(channels_, [&](const auto& entry) {
    return entry.first != channel && entry.second.accepted.continues(now_utime);
  });
}

/// Of a channel that begins: farther from every other that continues than its arrival can jitter.
bool SensorClocks::contradicts_others(const std::string& channel, std::int64_t utime,
                                      std::int64_t arrival_utime) const {
  const std::int64_t offset_us = utime - arrival_utime;
  return others_continue(channel, arrival_utime) &&
         std::ranges::none_of(channels_, [&](const auto& entry) {
           const Run& other = entry.second.accepted;
           return entry.first != channel && other.continues(arrival_utime) &&
                  std::abs(offset_us - other.offset_us) <= kOffsetChangeUs;
         });
}

std::string SensorClocks::fault(std::int64_t now_utime) const {
  for (const auto& [name, channel] : channels_) {
    if (channel.stands() && std::abs(now_utime - channel.last_repetition_utime) <= kContinuesUs) {
      return fmt::format("the clock of {} stands still", name);
    }
    const Run& rejected = channel.rejected;
    if (rejected.length < kLastingLength || !rejected.continues(now_utime)) continue;
    const double off_s =
        1e-6 * static_cast<double>(rejected.offset_us - channel.accepted.on_time_offset_us);
    return fmt::format("the clock of {} is {:.1f} s {}", name, std::abs(off_s),
                       off_s > 0.0 ? "ahead" : "behind");
  }
  for (const auto& [name, channel] : channels_) {
    const auto ahead_us = ahead_of_others_us(name, now_utime);
    if (ahead_us.value_or(0) < kAheadReportedUs) continue;
    return fmt::format("the clock of {} is {:.1f} s ahead of the others", name,
                       1e-6 * static_cast<double>(*ahead_us));
  }
  return {};
}

}  // namespace adit

// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "common/bus/bus.hpp"
#include "common/bus/typed_messages.hpp"

namespace adit {

/// Monitors the time stamps of the measurements that one stage receives. A stage orders them by
/// time, so one stamp in the future would make all later ones too old. A stamp that does not follow
/// the one before it on its channel is rejected. It may be late by any time, as a stage that was
/// suspended sees it, but not ahead of the earliest arrivals of its channel by more than a few of
/// its periods (as Olson, A passive solution to the sensor synchronization problem, IROS 2010,
/// takes the smallest latency for the true one). The first stamp of a channel may not be more than
/// half a second from all others. When a channel continues from a rejected stamp,
/// its clock was set: it is followed if no other channel of the stage contradicts it, as when the
/// clock of the computer was set or a log is played again; so is a channel that agrees with the
/// others by now, of which the first stamp was wrong. Otherwise the channel stays rejected
/// until its clock is right, and `fault` says by how much it is off. A step of less than half a
/// second is followed once it lasts, and reported while it makes a channel ahead of all others.
/// A process may receive its first measurements before it knows the time of the bus, or a simulated
/// time that is old: what lasts afterwards is the true offset of the channel.
class SensorClocks {
 public:
  static constexpr std::string_view kNotContinuous = "time stamp does not follow the one before";

  /// `on_set` is called when the clock of all channels was set, before the first measurement after.
  explicit SensorClocks(std::function<void()> on_set = {}) : on_set_(std::move(on_set)) {}

  /// Returns the reason for rejection, or an empty text. `utime`: of the measurement;
  /// `arrival_utime`: bus time at its arrival, both [µs since the epoch].
  std::string_view check(const std::string& channel, std::int64_t utime,
                         std::int64_t arrival_utime);

  /// The clock that is off at present, one clause; empty if none is.
  [[nodiscard]] std::string fault(std::int64_t now_utime) const;

 private:
  static constexpr std::size_t kSteps = 9;

  /// Measurements that follow each other.
  struct Run {
    std::int64_t first_arrival_utime = 0;
    std::int64_t last_arrival_utime = 0;
    std::int64_t last_utime = 0;
    std::int64_t offset_us = 0;                   ///< stamp minus arrival, of the last,
    std::int64_t on_time_offset_us = 0;           ///< of the last that was not late,
    std::int64_t earliest_offset_us = 0;          ///< and of those that arrived earliest
    std::int64_t off_time_since_utime = 0;        ///< arrival of the first that is not on time,
    int off_time_length = 0;                      ///< of those that follow it with about one offset
    std::array<std::int64_t, kSteps> steps_us{};  ///< between the last stamps, in any order
    int length = 0;

    /// Whether the stamp advances with the arrivals, or slower.
    [[nodiscard]] bool is_followed_by(std::int64_t utime, std::int64_t arrival_utime) const;
    /// Whether the stamp advances and agrees with the time of arrival.
    [[nodiscard]] bool agrees_with(std::int64_t utime, std::int64_t arrival_utime) const;
    /// How far a stamp may be ahead of those before, by the usual step between two.
    [[nodiscard]] std::int64_t ahead_max_us() const;
    /// Whether a measurement arrived within the last two seconds.
    [[nodiscard]] bool continues(std::int64_t now_utime) const;
    void add(std::int64_t utime, std::int64_t arrival_utime);
    void judge_offset(std::int64_t previous_offset_us);
  };
  struct Channel {
    Run accepted;
    Run rejected;                            ///< since the last one that was accepted
    int repetitions = 0;                     ///< of the last stamp that was accepted
    std::int64_t last_repetition_utime = 0;  ///< arrival

    [[nodiscard]] bool stands() const;
  };

  [[nodiscard]] bool is_ahead(const std::string& channel, std::int64_t utime,
                              std::int64_t arrival_utime) const;
  [[nodiscard]] std::optional<std::int64_t> ahead_of_others_us(const std::string& channel,
                                                               std::int64_t now_utime) const;
  [[nodiscard]] bool others_continue(const std::string& channel, std::int64_t now_utime) const;

  [[nodiscard]] bool contradicts_others(const std::string& channel, std::int64_t utime,
                                        std::int64_t arrival_utime) const;

  std::function<void()> on_set_;
  std::map<std::string, Channel, std::less<>> channels_;
};

/// As `subscribe`, for values with a stamp `utime` that a stage orders by time: those whose stamp
/// `clocks` rejects are counted as rejected. `clocks` must outlive the bus.
template <class Msg, class TypedHandler>
SubscriptionId subscribe_measured(Bus& bus, SensorClocks& clocks, std::string_view channel,
                                  Delivery delivery, TypedHandler handler) {
  return subscribe_checked<Msg>(
      bus, channel, delivery,
      [&clocks, channel = std::string(channel)](const auto& value, std::int64_t arrival_utime) {
        return clocks.check(channel, value.utime, arrival_utime);
      },
      std::move(handler));
}

}  // namespace adit

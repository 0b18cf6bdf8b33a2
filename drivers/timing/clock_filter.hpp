// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <deque>

namespace adit {

struct ClockFilterParams {
  double window_s = 30.0;   ///< of the events that count
  double drift_max = 0.01;  ///< largest difference of the rates of the two clocks, as a share
};

/// Maps the clock of a device to that of the computer, from the times at which its messages arrive.
/// A message is delayed by a constant and by what varies: scheduling, buffers, retransmission. The
/// variable part is never negative, so the line below all points (device time, arrival) passes
/// through the messages with the least delay, and its slope is the ratio of the two rates (Moon,
/// Skelly, Towsley, "Estimation and removal of clock skew from network delay measurements", INFOCOM
/// 1999; Olson, "A passive solution to the sensor synchronization problem", IROS 2010). Of the
/// lines below all points it is the one with the least sum of distances: the edge of their lower
/// hull over the mean device time. Needs no protocol and knows nothing of the constant part.
class ClockFilter {
 public:
  explicit ClockFilter(const ClockFilterParams& params = {}) : params_(params) {}

  /// An event with its time by the device and its arrival by the computer [µs]. Events are in order
  /// of device time; one that is not later than the last starts the filter again.
  void add(std::int64_t device_us, std::int64_t arrival_us);

  /// Time by the computer at which a message of this device time arrives with the least delay [µs].
  /// Must not be called before the first event.
  [[nodiscard]] double arrival_us(double device_us) const;

  /// Rate of the computer's clock by that of the device.
  [[nodiscard]] double rate() const { return 1.0 + slope_; }

  [[nodiscard]] bool is_empty() const { return points_.empty(); }
  void reset() { *this = ClockFilter(params_); }

 private:
  /// The event with the least delay of a part of the window.
  struct Point {
    double device_us = 0.0;  ///< since origin_us_
    double delay_us = 0.0;   ///< arrival minus device time, minus that of the first event
  };

  [[nodiscard]] double delay_of(std::int64_t device_us, std::int64_t arrival_us) const;
  void fit();

  ClockFilterParams params_;
  std::int64_t origin_us_ = 0;
  std::int64_t first_delay_us_ = 0;
  std::int64_t last_us_ = 0;
  std::deque<Point> points_;
  double slope_ = 0.0;
  double offset_us_ = 0.0;  ///< delay of the line at origin_us_
};

}  // namespace adit

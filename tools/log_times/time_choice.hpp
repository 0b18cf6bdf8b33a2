// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <map>
#include <optional>
#include <string>
#include <string_view>

#include "common/geometry/pose2.hpp"
#include "tools/log_times/clock_statistics.hpp"

namespace adit {

/// The times of one reading in a log; 0 where missing [µs since the epoch, or since any other
/// start].
struct RecordedTimes {
  std::int64_t measured_utime = 0;  ///< by the publisher of the reading
  std::int64_t logged_utime = 0;    ///< by the logger
};

/// Which times of a log are used.
struct TimeChoice {
  enum class Source {
    kMeasured,  ///< those of the publishers
    kLogged,    ///< those of the logger
    kOrder,     ///< the order in the file, with a constant time from scan to scan
  };

  Source source = Source::kMeasured;
  std::string defects;                   ///< of the times that are not used; empty for kMeasured
  std::string channel;                   ///< laser with the most scans, whose scans kOrder counts
  std::int64_t start_utime = 1'000'000;  ///< kOrder: time of its first scan
  double period_us = 0.0;                ///< kOrder: from scan to scan
  std::string period_origin;             ///< kOrder: what the period is from
  double readings_per_scan = 0.0;        ///< readings of other sensors between two scans
  std::size_t late = 0;  ///< readings out of order within kReorderWindowUs, sorted by time

  /// What is assumed, without the full stop; empty if the times of measurement are used in the
  /// order of the file.
  [[nodiscard]] std::string text() const;
};

/// Judges the times of a log in one pass over its readings, in the order of the file and in
/// constant memory. Times of measurement are used unless less than 90 % of the scans have a usable
/// one (ClockStatistics), then those of the logger under the same condition, otherwise the order in
/// the file. Its period is, in this order: the mean between changes of the clocks of scans, then of
/// other readings; the time in which a body at 0.5 m/s and 0.5 rad/s moves as wheel odometry does,
/// not below the period of the laser; the period of a SICK LMS (ScanTiming).
class TimeJudge {
 public:
  /// `T_wheel_body` as far as it is recorded with the scan.
  void add_scan(std::string_view channel, const RecordedTimes& times, double angle_step_rad,
                const Pose2* T_wheel_body = nullptr);
  /// A reading of another sensor; `T_wheel_body` for wheel odometry.
  void add_reading(std::string_view channel, const RecordedTimes& times,
                   const Pose2* T_wheel_body = nullptr);

  [[nodiscard]] std::size_t scans() const;
  [[nodiscard]] TimeChoice choose() const;
  /// Whether the logger's times of the scans are usable.
  [[nodiscard]] bool logged_usable() const;

 private:
  struct Clocks {
    ClockStatistics measured;
    ClockStatistics logged;
  };
  using Sensors = std::map<std::string, Clocks, std::less<>>;
  struct Motion {
    Pose2 T_wheel_body;      ///< at the last scan
    Pose2 T_wheel_body_now;  ///< of the last reading
    double moved_m = 0.0;    ///< in the steps from scan to scan that moved
    double turned_rad = 0.0;
    std::size_t steps = 0;
    std::size_t turns = 0;
  };
  struct Period {
    double us = 0.0;
    std::string origin;
  };

  [[nodiscard]] const Sensors::value_type* pace() const;
  [[nodiscard]] Period period() const;
  [[nodiscard]] double usable_share(ClockStatistics Clocks::*clock) const;
  [[nodiscard]] std::size_t late(ClockStatistics Clocks::*clock) const;
  void add_wheels(const Pose2& T_wheel_body);
  void add_motion();

  Sensors lasers_;
  Sensors others_;
  std::optional<Motion> motion_;
  std::size_t scans_ = 0;
  std::size_t readings_ = 0;
  double angle_step_rad_ = 0.0;
};

}  // namespace adit

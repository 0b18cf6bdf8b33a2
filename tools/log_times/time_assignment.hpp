// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <string_view>
#include <utility>

#include "tools/log_times/time_choice.hpp"

namespace adit {

/// Gives the readings of a log their times by a TimeChoice; to be called for each reading once, in
/// the order of the file. By order, readings between two scans are spread over the time between
/// them.
class TimeAssignment {
 public:
  explicit TimeAssignment(TimeChoice choice) : choice_(std::move(choice)) {}

  /// Time of the next reading, of a laser or another sensor; 0 if it has none [µs].
  std::int64_t next(std::string_view channel, const RecordedTimes& times);

  [[nodiscard]] const TimeChoice& choice() const { return choice_; }

 private:
  std::int64_t next_by_order(std::string_view channel);

  TimeChoice choice_;
  double scans_ = 0.0;
  double readings_since_scan_ = 0.0;
};

}  // namespace adit

// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>

#include "sim/laser/laser_params.hpp"

namespace adit {

/// When the scans of one laser begin and end: back to back, one each period.
class ScanSchedule {
 public:
  /// The first scan begins at `start_utime` and `phase` periods, 0 to 1.
  ScanSchedule(const LaserParams& params, std::int64_t start_utime, double phase);

  [[nodiscard]] std::int64_t begin_utime() const;  ///< of the next scan: its first beam
  [[nodiscard]] std::int64_t end_utime() const;    ///< its last beam
  /// Whether it is among those of LaserParams::keep_every.
  [[nodiscard]] bool is_kept() const { return scan_ % keep_every_ == 0; }
  void go_on() { ++scan_; }

 private:
  std::int64_t start_utime_;
  double phase_;
  double period_s_;
  double last_beam_s_;
  std::int64_t keep_every_;
  std::int64_t scan_ = 0;
};

}  // namespace adit

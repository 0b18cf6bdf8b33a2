// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "common/sensing/scan_match.hpp"

namespace adit {

/// The segments of a run in which scans were degenerate or lost, in bounded memory: segments of one
/// kind are joined if the body moves at most `joined_m` between them. The distance begins at
/// kJoinedM and doubles whenever there would be more than kSegmentsMax segments.
class SegmentList {
 public:
  static constexpr double kJoinedM = 2.0;  // less than the length of a local map
  static constexpr std::size_t kSegmentsMax = 200;

  struct Segment {
    std::int64_t from_utime = 0;
    std::int64_t to_utime = 0;
    double length_m = 0.0;      ///< of the intervals, without the motion between them
    std::size_t scans = 0;      ///< of the intervals
    std::size_t intervals = 0;  ///< of consecutive scans of this kind
    bool lost = false;          ///< false: degenerate
    bool filled = false;        ///< degenerate, with the open direction taken from odometry or gyro
    double from_m = 0.0;        ///< sum of the motions of all scans up to here
    double to_m = 0.0;
  };

  /// Adds the next match with a pose.
  void add(const ScanMatch& match);

  /// In order of their starts.
  [[nodiscard]] const std::vector<Segment>& segments() const { return segments_; }
  [[nodiscard]] double joined_m() const { return joined_m_; }

 private:
  void join();

  std::vector<Segment> segments_;
  double joined_m_ = kJoinedM;
  double travelled_m_ = 0.0;
  int last_kind_ = 0;  // of the last scan
};

/// True for a lost scan and for one with a degenerate direction.
bool is_unobserved(const ScanMatch& match);

}  // namespace adit

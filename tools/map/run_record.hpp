// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <map>
#include <string>
#include <vector>

#include "common/bus/bus.hpp"
#include "common/sensing/laser_scan.hpp"
#include "common/sensing/scan_match.hpp"
#include "tools/eval/trajectory.hpp"

namespace adit {

/// Listens to a run and keeps what its files are made of: every scan with what became of it.
class RunRecord {
 public:
  struct Entry {
    LaserScan scan;
    ScanMatch match;
  };

  /// A stretch of the way over which scans left a direction open or matched nothing.
  struct Stretch {
    std::int64_t from_utime = 0;
    std::int64_t to_utime = 0;
    double length_m = 0.0;
    int scans = 0;
    bool lost = false;    ///< otherwise degenerate
    bool filled = false;  ///< degenerate, but odometry or gyro stood in
  };

  /// `bus` must outlive this.
  explicit RunRecord(Bus& bus);

  /// The scans that gave a pose, in order.
  [[nodiscard]] const std::vector<Entry>& entries() const { return entries_; }
  [[nodiscard]] std::size_t refused_scans() const { return refused_; }

  [[nodiscard]] Trajectory trajectory() const;
  [[nodiscard]] std::vector<Stretch> stretches() const;

 private:
  void listen_to_laser(Bus& bus, std::string_view channel);
  void on_match(const ScanMatch& match);

  std::map<std::string, LaserScan> last_scan_;
  std::vector<Entry> entries_;
  std::size_t refused_ = 0;
};

}  // namespace adit

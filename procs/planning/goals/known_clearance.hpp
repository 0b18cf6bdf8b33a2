// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <optional>
#include <utility>
#include <vector>

#include "common/geometry/pose2.hpp"
#include "common/types/planned_path.hpp"

namespace adit {

/// The clearance along the paths that were planned over scans, for a return along them without
/// a scan. Frame odom; forgotten where odom was reset.
class KnownClearance {
 public:
  /// Poses of the body in order of time. One that no vehicle can have reached since the last one
  /// lies in another odom frame.
  void add_pose(const Pose2& T_odom_body);
  /// Adds a path that was found over a scan.
  void add_path(const PlannedPath& path);

  /// The least clearance of planned points at this pose, in either direction of travel [m].
  [[nodiscard]] std::optional<double> at(const Pose2& T_odom_body) const;
  /// Sets the clearance of the points of a path along the traversed path (kRetracedClearanceM)
  /// where it is known; points that were planned over a scan keep theirs.
  void apply(PlannedPath& path) const;

 private:
  void clear();

  struct Point {
    Pose2 T_odom_body;
    double clearance_m = 0.0;
  };
  using Cell = std::pair<std::int64_t, std::int64_t>;

  std::optional<Pose2> T_odom_body_;
  std::map<Cell, std::vector<Point>> cells_;
  std::size_t points_ = 0;
};

}  // namespace adit

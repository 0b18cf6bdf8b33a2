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
  /// Where odom lies in map. When a loop closure moves it, paths of long ago keep their place in
  /// map (kKeepsPlaceInOdomM), as the traversed path does.
  void set_correction(const Pose2& T_map_odom);
  /// Adds a path that was found over a scan.
  void add_path(const PlannedPath& path);

  /// The least clearance of planned points at this pose, in either direction of travel and with
  /// either end of the vehicle ahead [m].
  [[nodiscard]] std::optional<double> at(const Pose2& T_odom_body) const;
  /// Sets the clearance of the points of a path along the traversed path (kRetracedClearanceM)
  /// where it is known; points that were planned over a scan keep theirs.
  void apply(PlannedPath& path) const;

 private:
  struct Point {
    Pose2 T_odom_body;
    double clearance_m = 0.0;
    double driven_m = 0.0;  ///< distance travelled when it was planned
  };
  using Cell = std::pair<std::int64_t, std::int64_t>;

  void clear();
  void add(const Point& point);

  std::optional<Pose2> T_odom_body_;
  std::optional<Pose2> T_map_odom_;
  double driven_m_ = 0.0;
  std::map<Cell, std::vector<Point>> cells_;
  std::size_t points_ = 0;
};

}  // namespace adit

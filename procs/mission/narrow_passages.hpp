// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <vector>

#include "common/geometry/pose2.hpp"
#include "common/types/planned_path.hpp"

namespace adit {

/// Passages to frontiers of which a scan could not tell whether the vehicle fits: no path, but by
/// less than the map resolves (PlanOutcome::kNarrow). While one is doubtful its frontier is not
/// surely blocked. Better evidence decides it: the robot has driven through, or two scans from
/// nearer show that no path exists. Walls are mapped the coarser the farther they are away, so that
/// a scan from as far as that of the doubt decides nothing.
class NarrowPassages {
 public:
  using FrontierId = std::optional<std::int32_t>;

  /// The greatest progress of the vehicle towards a frontier by one scan, and that place, in odom
  /// with the x axis along the route.
  struct Reach {
    double distance_m = 0.0;  ///< from the robot
    std::optional<Pose2> T_odom_end = {};
  };

  /// A scan could not tell whether the vehicle fits.
  void add_doubt(FrontierId frontier, const Reach& reach);
  /// A scan showed that no path exists.
  void add_blocked(FrontierId frontier, double distance_m);
  /// A path that leads through is evidence for the passage, from where it was planned.
  void add_path(const std::vector<PathPoint>& points);
  /// The robot is there.
  void add_pose(const Pose2& T_odom_body);
  /// The odom frame is no longer valid: whether the robot drives through is not known any more.
  void reset_odom();

  [[nodiscard]] bool is_doubtful(FrontierId frontier) const;

 private:
  struct Passage {
    Reach nearest;         ///< of the scans that may show a passage
    int blocked_near = 0;  ///< scans from nearer that showed none
  };

  std::map<FrontierId, Passage> passages_;
};

}  // namespace adit

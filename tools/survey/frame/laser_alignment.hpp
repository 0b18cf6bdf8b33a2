// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include <Eigen/Core>

#include "common/pose_graph/map_graph.hpp"
#include "common/sensing/laser_mount.hpp"
#include "common/types/cloud_match.hpp"
#include "tools/survey/input/cloud_store.hpp"

namespace adit {

/// The rotation by which a 3D scan fits on an older one, and what it should have been.
struct ScanRotation {
  std::int64_t older_utime = 0;  ///< Cloud::utime
  std::int64_t newer_utime = 0;
  bool older_is_front = true;  ///< taken with the front laser
  bool newer_is_front = true;
  double turn_rad = 0.0;  ///< from the older to the newer scan
  /// Rotation vector of the newer level frame against the older one, along the axes of the newer
  /// one, that remains without that turn [rad].
  Eigen::Vector3d remaining_rad = Eigen::Vector3d::Zero();
  Eigen::Matrix2d tilt_covariance = Eigen::Matrix2d::Identity();  ///< of its x and y [rad²]
};

/// The matches of 3D scans of which both are known. What remains about z is the match less the
/// graph.
std::vector<ScanRotation> scan_rotations(const std::vector<CloudMatch>& matches,
                                         const MapGraph& graph, const CloudStore& clouds,
                                         const Lasers& lasers);

/// How the front laser stands against the rear one, other than the stages take it for. Both see one
/// place with different headings: with constant errors e of their level frames, a newer scan of one
/// laser shows R(−turn) e_older − e_newer against an older one of the other or of the same. What
/// both have in common does not count.
struct LaserAlignment {
  std::size_t matches = 0;  ///< between scans of different lasers
  /// True less stated rotation of the front laser, about x, y, z of the body (roll, pitch, yaw).
  Eigen::Vector3d rotation_rad = Eigen::Vector3d::Zero();
  Eigen::Vector3d sd_rad = Eigen::Vector3d::Zero();  ///< by leaving out each scan

  /// Whether the rotation about an axis is more than its uncertainty and than what a survey can
  /// bear.
  [[nodiscard]] bool is_off(int axis) const;
};

inline constexpr std::size_t kAlignmentMatchesMin = 6;
/// Least squares with a robust kernel over all matches; nothing with fewer than
/// kAlignmentMatchesMin between scans of different lasers.
std::optional<LaserAlignment> laser_alignment(const std::vector<ScanRotation>& rotations);

}  // namespace adit

// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <vector>

#include <Eigen/Core>

#include "procs/mission/maneuver.hpp"
#include "procs/mission/traversed_path.hpp"

namespace adit {

/// Chooses how far the robot drives along the traversed path, and forgets it after a failed drive
/// until a drive arrives.
class Retracing {
 public:
  /// Poses of another odom frame are invalid.
  void reset() { *this = {}; }
  /// The robot made progress, or the target changed.
  void note_progress() { rejoins_ = 0; }
  void note_drive(bool failed) { failed_ = failed; }

  /// Whether the robot can go back at all.
  [[nodiscard]] static bool leads_back(const TraversedPath& path);
  [[nodiscard]] static bool can_back_off(const TraversedPath& path, double distance_m);

  /// Length of a rejoin; empty if the traversed path does not lead to the target. On the return
  /// home it always does, if by a detour; the length grows with the number of rejoins.
  [[nodiscard]] std::optional<double> rejoin_length_m(
      const TraversedPath& path, const std::vector<Eigen::Vector2d>& route_odom,
      bool returning_home) const;

  /// `present`: the maneuver that is interrupted.
  [[nodiscard]] BackOff back_off(const TraversedPath& path, double distance_m,
                                 const Maneuver& present) const;
  /// `has_terrain`: of the present odom frame. Without it, the path is retraced pose by pose.
  [[nodiscard]] Rejoin rejoin(const TraversedPath& path, double length_m, bool has_terrain,
                              const Maneuver& present);

 private:
  bool failed_ = false;  ///< the last drive along the traversed path
  int rejoins_ = 0;      ///< since progress was made
};

}  // namespace adit

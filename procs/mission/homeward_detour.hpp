// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <vector>

#include <Eigen/Core>

#include "procs/mission/traversed_path.hpp"

namespace adit {

/// The return along the traversed path where route after route of exploration is blocked: it may
/// lead round an obstacle that the map does not show, such as rails that the robot does not cross,
/// and that each blocked route moves by a metre. Each time one is begun it is twice as long; in the
/// end the robot goes home along all of it.
class HomewardDetour {
 public:
  static constexpr int kBlockedBefore = 3;  ///< routes home, before the first
  static constexpr double kFirstM = 12.0;

  /// The target has changed, or the odom frame.
  void reset() { *this = {}; }
  /// A route home of exploration was blocked. Begins one at every second of them from the third on:
  /// in between the mission tries the same place from another side.
  void note_blocked(const TraversedPath& path);
  [[nodiscard]] bool is_active() const { return ends_at_m_.has_value(); }
  /// It is done, or blocked.
  void end() { ends_at_m_.reset(); }

  /// What is left of it [m]; of the traversed path, whose turns the route cuts.
  [[nodiscard]] double left_m(const TraversedPath& path) const;
  /// The route along it, from the body on: its next 40 m at most, two points at least. Nothing if
  /// it is done.
  [[nodiscard]] std::optional<std::vector<Eigen::Vector2d>> route_odom(
      const TraversedPath& path) const;

 private:
  int blocked_ = 0;
  int begun_ = 0;
  std::optional<double> ends_at_m_;  ///< length of the traversed path back to the start
};

}  // namespace adit

// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include <Eigen/Core>

#include "sim/world/plan/tunnel_line.hpp"

namespace adit {

/// Where a tunnel of one level continues as a tunnel of another: both end at the same point, in
/// line, with the same width.
struct LevelJoint {
  Eigen::Vector2d p_world{0.0, 0.0};  ///< [m]
  Eigen::Vector2d along{1.0, 0.0};    ///< unit, from the lower to the higher level number
  int low = 0;                        ///< level number
  int high = 0;
  double half_width_m = 0.0;
  double overlap_m = 0.0;  ///< length to both sides that both levels have
};

/// Tunnels by level. Tunnels of different levels may lie above each other; each level is a plan of
/// its own, which overlaps with others at joints. Of the overlap, each level owns its side, so that
/// surfaces built level by level fit together.
class LevelPlan {
 public:
  /// Throws std::invalid_argument with the name of a tunnel if two tunnels meet at their ends but
  /// not in line or with different widths, or the rest of a level is too close to a joint.
  explicit LevelPlan(std::vector<TunnelLine> tunnels);

  /// Level numbers, ascending; {0} without tunnels.
  [[nodiscard]] const std::vector<int>& levels() const { return levels_; }
  [[nodiscard]] const std::vector<LevelJoint>& joints() const { return joints_; }
  /// The tunnels of a level, and the first metres of those that continue it on other levels.
  [[nodiscard]] std::vector<TunnelLine> lines_on(int level) const;
  /// Whether a point of the plan of a level belongs to it, not to a level that continues it.
  [[nodiscard]] bool owns(int level, const Eigen::Vector2d& p_world) const;
  /// Whether a point is where two levels overlap.
  [[nodiscard]] bool is_at_joint(int level, const Eigen::Vector2d& p_world) const;

 private:
  void add_joint(std::size_t a, bool a_at_end, std::size_t b, bool b_at_end);
  void check_surroundings() const;

  std::vector<TunnelLine> tunnels_;
  std::vector<int> levels_;
  std::vector<LevelJoint> joints_;
  /// Continuations: level on which it is needed, and the line.
  struct Tail {
    int level = 0;
    TunnelLine line;
  };
  std::vector<Tail> tails_;
};

/// Whether an end of a tunnel is an end of a tunnel of another level.
bool is_level_joint(const std::vector<TunnelLine>& tunnels, std::size_t tunnel,
                    const Eigen::Vector2d& end);

}  // namespace adit

// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <limits>
#include <optional>
#include <unordered_set>
#include <vector>

#include <Eigen/Core>

#include "common/geometry/pose2.hpp"

namespace adit {

/// A pose of the body on ground that it drove over, with its height in the same frame [m].
struct DrivenPose : Pose2 {
  double z_m = 0.0;
};

/// Part of a route that the robot has driven before, in either direction.
struct GraphPath {
  double shared_m = 0.0;           ///< length of the first part of the route that it follows
  std::vector<std::size_t> nodes;  ///< from the first one on, which is where it began
};

/// All ground that the body drove over, as a graph: its nodes are the poses, its edges the drives
/// between two of them. Each edge has carried the robot and can be driven in either direction.
class DrivenGraph {
 public:
  /// The node of this pose: one that is the same already, or a new one. Another pose above or below
  /// it, on another level, is not the same. `driven_m`: distance travelled when it was driven.
  std::size_t add(const DrivenPose& pose, double driven_m);
  /// Moves a node to the same pose as it was measured now.
  void update(std::size_t node, const DrivenPose& pose, double driven_m);
  /// The robot drove from one node to the other.
  void connect(std::size_t a, std::size_t b);
  /// Moves the nodes that were driven last before a distance travelled.
  void move(const Pose2& T_after_before, double z_after_before_m,
            double driven_max_m = std::numeric_limits<double>::infinity());
  /// Puts the nodes of another graph in the same frame before those of this one, whose numbers
  /// increase by its size.
  void prepend(const DrivenGraph& earlier);

  [[nodiscard]] std::size_t size() const { return nodes_.size(); }
  [[nodiscard]] const DrivenPose& pose(std::size_t node) const { return nodes_[node].pose; }

  /// What limits a path.
  struct PathOptions {
    bool may_reverse = true;  ///< the robot sees behind itself
    /// Nodes that it may use; all if empty.
    std::optional<std::unordered_set<std::size_t>> among;
  };

  /// Follows a route from a node on as far as it was driven, 1 m beside it at most; of several
  /// paths the shortest.
  [[nodiscard]] GraphPath along(std::size_t from, const std::vector<Eigen::Vector2d>& route,
                                const PathOptions& options) const;
  /// The same from any node beside the first `join_m` of the route, at this height.
  [[nodiscard]] GraphPath joining(const std::vector<Eigen::Vector2d>& route, double join_m,
                                  double z_m) const;

 private:
  struct Node {
    DrivenPose pose;
    double driven_m = 0.0;
    std::vector<std::size_t> neighbours;
  };

  struct Source {
    std::size_t node = 0;
    double along_m = 0.0;  ///< of the route
    double length_m = 0.0;
  };
  [[nodiscard]] GraphPath search(const std::vector<Source>& sources,
                                 const std::vector<Eigen::Vector2d>& route,
                                 const PathOptions& options) const;

  std::vector<Node> nodes_;
};

/// Whether two poses of the body are equal within the accuracy of driving, on one level.
bool is_same(const DrivenPose& a, const DrivenPose& b);

/// Whether two heights of the body are on one level.
bool is_same_level(double z_a_m, double z_b_m);

}  // namespace adit

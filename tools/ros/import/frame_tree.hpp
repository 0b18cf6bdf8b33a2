// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include <Eigen/Geometry>

#include "tools/ros/messages/ros_messages.hpp"

namespace adit {

/// The frames of a bag, as tf2 has them: each with the pose in its parent over time. Of a frame
/// that gets another parent the first one counts.
class FrameTree {
 public:
  /// Transforms of one frame in order of time; one that is older than the last is ignored. A static
  /// one is valid at all times.
  void add(const RosTransform& transform, bool is_static);

  [[nodiscard]] bool has(const std::string& frame) const;
  /// Whether the pose of the frame in its parent changes.
  [[nodiscard]] bool moves(const std::string& frame) const;
  /// Nothing for the root, and for a frame that is not known.
  [[nodiscard]] std::optional<std::string> parent(const std::string& frame) const;

  /// T_a_b at a time: interpolated, and the nearest before the first and behind the last one.
  /// Nothing if the frames are not connected.
  [[nodiscard]] std::optional<Eigen::Isometry3d> lookup(const std::string& a, const std::string& b,
                                                        std::int64_t utime) const;
  /// Whether T_a_b changes.
  [[nodiscard]] bool moves(const std::string& a, const std::string& b) const;
  /// The times of all poses that move, between a and b.
  [[nodiscard]] std::vector<std::int64_t> times_of(const std::string& a,
                                                   const std::string& b) const;

  /// The frame above this one to which it is rigidly attached: the highest below a pose that moves.
  [[nodiscard]] std::string rigid_root(const std::string& frame) const;

 private:
  struct Sample {
    std::int64_t utime = 0;
    Eigen::Isometry3d T_parent_child = Eigen::Isometry3d::Identity();
  };
  struct Edge {
    std::string parent;
    std::vector<Sample> samples = {};  ///< of equal ones that follow each other the first and last
    bool moves = false;
  };

  [[nodiscard]] static Eigen::Isometry3d pose_at(const Edge& edge, std::int64_t utime);
  [[nodiscard]] std::vector<std::string> chain(const std::string& frame) const;
  /// The frames between a and b up to their common ancestor, without it; nothing if there is none.
  [[nodiscard]] std::optional<std::pair<std::vector<std::string>, std::vector<std::string>>>
  between_frames(const std::string& a, const std::string& b) const;

  std::map<std::string, Edge> edges_;  ///< by child
};

}  // namespace adit

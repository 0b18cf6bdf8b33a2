// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include <Eigen/Core>

#include "common/geometry/level_pose.hpp"
#include "tools/map/full_map.hpp"

namespace adit {

/// The local maps in the frame of the survey, with their covariances. Everything measured is placed
/// by the local map in whose time it was measured. Without control the frame is map, in which the
/// first local map is fixed.
class SurveyGraph {
 public:
  struct Node {
    int id = 0;       ///< of the local map
    int session = 0;  ///< of its odom frame
    LevelPose T_map_local;
    LevelPose T_survey_local;
    /// Of the plan: (x, y, θ), small motions of the local map along the axes of survey at its
    /// origin [m², m rad, rad²].
    Eigen::Matrix3d covariance = Eigen::Matrix3d::Zero();
    double z_variance = 0.0;  ///< [m²]
    /// The same of the pose relative to the local map before; zero for the first one.
    Eigen::Matrix3d step_covariance = Eigen::Matrix3d::Zero();
    double step_z_variance = 0.0;  ///< [m²]
    LevelPose T_odom_local;
    std::int64_t utime = 0;  ///< of its first scan
  };

  /// The graph as mapping left it: a free network, relative to its first local map. Local maps that
  /// the log lacks are left out. Throws std::runtime_error if the graph is not connected.
  static SurveyGraph free_network(const FullMap& map);

  explicit SurveyGraph(std::vector<Node> nodes) : nodes_(std::move(nodes)) {}

  [[nodiscard]] const std::vector<Node>& nodes() const { return nodes_; }
  /// The local map in whose time something was measured; the first one for what is older.
  [[nodiscard]] std::size_t node_at(std::int64_t utime) const;
  /// The local map whose origin is nearest to a place in map.
  [[nodiscard]] std::size_t node_near(const Eigen::Vector2d& p_map) const;
  /// The same for a place in survey.
  [[nodiscard]] std::size_t node_near_in_survey(const Eigen::Vector2d& p_survey) const;

  /// T_survey_map by one local map: the same for all of them in a free network.
  [[nodiscard]] LevelPose T_survey_map(std::size_t node) const;

  /// Covariance of a point in survey that is rigidly attached to a local map, in three dimensions
  /// [m²]. Plan and height are estimated apart.
  [[nodiscard]] Eigen::Matrix3d covariance_at(std::size_t node,
                                              const Eigen::Vector3d& p_survey) const;

  /// Covariance (x, y, θ) of a pose at the second node relative to one at the first, `from` before
  /// `to`, along the axes of survey: the sum of the steps between them, which neglects that loop
  /// closures tie them, too.
  [[nodiscard]] Eigen::Matrix3d covariance_between(std::size_t from, std::size_t to) const;
  /// The same of the heights [m²].
  [[nodiscard]] double z_variance_between(std::size_t from, std::size_t to) const;

 private:
  std::vector<Node> nodes_;  // in order of time
};

}  // namespace adit

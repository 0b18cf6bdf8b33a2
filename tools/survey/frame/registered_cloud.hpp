// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include <Eigen/Core>

#include "common/geometry/level_pose.hpp"
#include "common/types/cloud.hpp"
#include "tools/survey/frame/survey_graph.hpp"

namespace adit {

/// Standard deviation of a return along its beam [m], which the pose graph does not know.
inline constexpr double kRangeSdM = 0.01;

/// A 3D scan in the frame of the survey.
struct PlacedCloud {
  const Cloud* cloud = nullptr;
  int number = 0;        ///< in the order of the log, from 1
  std::size_t node = 0;  ///< of SurveyGraph, to which it is attached
  LevelPose T_survey_level;
  Eigen::Matrix3d correction = Eigen::Matrix3d::Identity();  ///< of its level frame
  double level_sd_rad = 0.0;  ///< of roll and pitch of that frame, corrected

  [[nodiscard]] Eigen::Vector3d in_survey(const Eigen::Vector3d& p_level) const {
    return T_survey_level * Eigen::Vector3d(correction * p_level);
  }
};

/// A return.
struct SurveyPoint {
  Eigen::Vector3d p_survey;
  std::int64_t utime = 0;  ///< of its line
  const PlacedCloud* scan = nullptr;
};

/// All 3D scans of a mission in the frame of the survey. A scan is attached to the local map in
/// whose time its sweep ended, so that it moves with that one; its level frame is turned into the
/// vertical (LevelCorrection).
class RegisteredCloud {
 public:
  /// `clouds` and `graph` must outlive this.
  RegisteredCloud(const std::vector<Cloud>& clouds, const SurveyGraph& graph);

  [[nodiscard]] const std::vector<PlacedCloud>& scans() const { return scans_; }
  [[nodiscard]] std::size_t points() const { return points_; }
  [[nodiscard]] const SurveyGraph& graph() const { return graph_; }

  /// Calls `visit` with each point, scan by scan.
  template <class Visit>
  void for_each_point(Visit visit) const {
    for (const PlacedCloud& scan : scans_) for_each_point_of(scan, visit);
  }

  /// The same for one of scans().
  template <class Visit>
  static void for_each_point_of(const PlacedCloud& scan, Visit& visit) {
    for (const CloudLine& line : scan.cloud->lines) {
      for (const Eigen::Vector3f& p_level : line.points)
        visit(SurveyPoint{scan.in_survey(p_level.cast<double>()), line.utime, &scan});
    }
  }

  /// Covariance of a point in survey [m²]: of its local map in the graph, of the level frame of its
  /// scan, and of its range.
  [[nodiscard]] Eigen::Matrix3d covariance(const SurveyPoint& point) const;
  /// The part of it that differs from scan to scan and from point to point.
  [[nodiscard]] Eigen::Matrix3d scan_covariance(const SurveyPoint& point) const;

 private:
  const SurveyGraph& graph_;
  std::vector<PlacedCloud> scans_;
  std::size_t points_ = 0;
};

}  // namespace adit

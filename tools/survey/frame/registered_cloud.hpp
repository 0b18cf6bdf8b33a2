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
#include "tools/survey/input/cloud_store.hpp"

namespace adit {

/// Standard deviation of a return along its beam [m], which the pose graph does not know.
inline constexpr double kRangeSdM = 0.01;

/// A 3D scan in the frame of the survey.
struct PlacedCloud {
  std::int64_t utime = 0;  ///< end of its sweep [µs since the epoch]
  int number = 0;          ///< in the order of the log, from 1
  std::size_t node = 0;    ///< of SurveyGraph, to which it is attached
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
  RegisteredCloud(const CloudStore& clouds, const SurveyGraph& graph);

  [[nodiscard]] const std::vector<PlacedCloud>& scans() const { return scans_; }
  [[nodiscard]] std::size_t points() const { return points_; }
  [[nodiscard]] std::size_t points_of(const PlacedCloud& scan) const {
    return clouds_.points(index_of(scan));
  }
  /// In its level frame.
  [[nodiscard]] std::vector<CloudLine> lines_of(const PlacedCloud& scan) const {
    return clouds_.lines(index_of(scan));
  }
  /// Of one of scans(), with its first line only, and that without points.
  [[nodiscard]] const Cloud& scan_of(const PlacedCloud& scan) const {
    return clouds_[index_of(scan)];
  }
  [[nodiscard]] const SurveyGraph& graph() const { return graph_; }

  /// Calls `visit` with each point, scan by scan.
  template <class Visit>
  void for_each_point(Visit visit) const {
    for (const PlacedCloud& scan : scans_) for_each_point_of(scan, visit);
  }

  /// The same for one of scans().
  template <class Visit>
  void for_each_point_of(const PlacedCloud& scan, Visit& visit) const {
    for (const CloudLine& line : lines_of(scan)) {
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
  [[nodiscard]] static std::size_t index_of(const PlacedCloud& scan) {
    return static_cast<std::size_t>(scan.number) - 1;
  }

  const CloudStore& clouds_;
  const SurveyGraph& graph_;
  std::vector<PlacedCloud> scans_;
  std::size_t points_ = 0;
};

}  // namespace adit

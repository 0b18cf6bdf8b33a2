// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <map>

#include <Eigen/Core>

#include "common/config/bounds.hpp"
#include "common/geometry/pose2.hpp"
#include "common/sensing/laser_scan.hpp"
#include "procs/scan_matching/motion/motion_prediction.hpp"

namespace adit {

struct LaserDisagreementParams {
  double memory_s = 1.0;  ///< time constant of the mean corrections

  template <class V>
  void visit(V& v) {
    v("memory_s", memory_s, within(0.01, 60.0));
  }
};

/// Estimates the systematic error of scan matching from lasers that disagree, and fuses matches
/// with the wheels accordingly. Where walls lean, one laser finds the body ahead of what the wheels
/// predict and the other behind, scan after scan, each with a standard deviation of millimetres:
/// the pose drifts to whichever constrains it more. What both lasers correct alike is an
/// error of the wheels; half of what they correct differently is an error of the matches. A laser
/// is no witness along an axis on which its match knows less than the prediction.
class LaserDisagreement {
 public:
  explicit LaserDisagreement(const LaserDisagreementParams& params) : params_(params) {}

  /// The pose of a scan, where matched and predicted poses are fused with this error.
  /// `T_odom_match`: pose by match and prior; `information`: of the match alone (x, y, θ in the
  /// frame of the body), of which the systematic error is taken off. Without wheels, or before two
  /// lasers have matched, both stay as they are.
  Pose2 fuse(LaserId laser, std::int64_t utime, const MotionEstimate& expected,
             const Pose2& T_odom_match, Eigen::Matrix3d& information);

  /// The systematic error of a match at present [m], in the frame of the body.
  [[nodiscard]] Eigen::Vector2d error_m(std::int64_t utime) const;

 private:
  /// The correction, or that of the other laser along axes on which this one is no witness.
  [[nodiscard]] Eigen::Vector2d witnessed(LaserId laser, const Eigen::Vector2d& correction_m,
                                          const Eigen::Matrix2d& match,
                                          const Eigen::Matrix2d& prior) const;

  struct Mean {
    std::int64_t utime = 0;
    Eigen::Vector2d correction_m = Eigen::Vector2d::Zero();
  };
  LaserDisagreementParams params_;
  std::map<LaserId, Mean> means_;
};

}  // namespace adit

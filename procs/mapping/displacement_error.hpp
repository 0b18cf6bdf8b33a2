// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>

#include "common/config/bounds.hpp"
#include "common/geometry/pose2.hpp"
#include "common/sensing/scan_match.hpp"

namespace adit {

struct DisplacementErrorParams {
  double floor_m = 0.003;  ///< of each displacement, however short: the matches at its ends
  double floor_rad = 0.001;
  double drift_m_per_sqrt_m = 0.004;  ///< more for the way, as of a random walk
  double drift_rad_per_sqrt_m = 0.0008;
  double drift_rad_per_sqrt_rad = 0.0015;
  double dense_m = 0.25;      ///< scans farther apart draw the walls more faintly, and drift more
  double speed_sd_m_s = 0.3;  ///< of a motion that nothing measured: a last speed was assumed
  double turn_sd_rad_s = 0.3;
  /// Walls seen before an unmeasured stretch shorter than this are seen after.
  double unobserved_max_m = 1.0;
  int lost_max_bridged = 2;  ///< and so are they after as many lost scans

  template <class V>
  void visit(V& v) {
    v("floor_m", floor_m, within(1e-4, 10.0));
    v("floor_rad", floor_rad, within(1e-5, 1.0));
    v("drift_m_per_sqrt_m", drift_m_per_sqrt_m, within(0.0, 10.0));
    v("drift_rad_per_sqrt_m", drift_rad_per_sqrt_m, within(0.0, 1.0));
    v("drift_rad_per_sqrt_rad", drift_rad_per_sqrt_rad, within(0.0, 1.0));
    v("dense_m", dense_m, above(0.0));
    v("speed_sd_m_s", speed_sd_m_s, within(0.001, 100.0));
    v("turn_sd_rad_s", turn_sd_rad_s, within(0.001, 100.0));
    v("unobserved_max_m", unobserved_max_m, within(0.0, 100.0));
    v("lost_max_bridged", lost_max_bridged, within(0, 1000));
  }
};

/// How far the displacement of the body over some metres, as scan matching gives it, may be from
/// the truth. Scan matching holds each scan against the walls of many metres, so the errors of its
/// steps cancel for the most part, and the sum of their covariances says nothing of the error of
/// the whole. What remains is a drift with the way and the turns, and, in the directions that the
/// scans left open, what stood in for them: the odometry's error, which is taken as independent
/// from step to step, or that of an assumed speed, which is the same in all steps. A short stretch
/// of open or lost scans leaves nothing behind: the next good scan is held against the same walls.
class DisplacementError {
 public:
  explicit DisplacementError(const DisplacementErrorParams& params) : params_(params) {}

  /// The displacement counts from here.
  void reset();

  /// The body made this step, ending with `match`.
  void add_step(const Pose2& T_last_body, const ScanMatch& match);

  /// The way from one scan to the next that was used. Apart from the steps, since a body at rest
  /// jitters but does not drift.
  void add_travel(double distance_m, double turn_rad);

  /// Of (x, y, θ) in the present body frame [m, m, rad]. Positive definite.
  [[nodiscard]] Eigen::Matrix3d covariance() const;

 private:
  /// A covariance: what is independent from step to step, and the root of what is common to all.
  struct ErrorCovariance {
    Eigen::Matrix3d independent = Eigen::Matrix3d::Zero();
    Eigen::Matrix3d common_root = Eigen::Matrix3d::Zero();

    void move(const Eigen::Matrix3d& Ad);
    void add(const ErrorCovariance& other);
    [[nodiscard]] Eigen::Matrix3d sum() const;
  };

  [[nodiscard]] ErrorCovariance unobserved_error(const ScanMatch& match) const;
  [[nodiscard]] ErrorCovariance unconstrained_error(const DegenerateDirection& direction,
                                                    const ScanMatch& match) const;
  void end_unobserved_stretch();

  DisplacementErrorParams params_;
  ErrorCovariance accumulated_;
  ErrorCovariance unobserved_;  ///< of the unmeasured stretch that goes on
  double unobserved_m_ = 0.0;
  int unobserved_lost_ = 0;
};

}  // namespace adit

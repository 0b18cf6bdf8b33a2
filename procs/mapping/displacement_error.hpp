// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include <Eigen/Core>

#include "common/config/bounds.hpp"
#include "common/geometry/pose2.hpp"
#include "common/sensing/scan_match.hpp"

namespace adit {

struct DisplacementErrorParams {
  /// Minimum standard deviation of a displacement, from the matches at its ends.
  double floor_m = 0.003;
  double floor_rad = 0.001;
  double drift_m_per_sqrt_m = 0.004;  ///< random walk along the path
  double drift_rad_per_sqrt_m = 0.0008;
  double drift_rad_per_sqrt_rad = 0.0015;
  double dense_m = 0.25;  ///< scans farther apart sample the walls less densely and drift more
  double wheels_m_per_sqrt_m = 0.02;  ///< of a distance that only the wheels measured: random walk
  double wheels_scale_sd = 0.015;     ///< and error of scale, at least; scan matching states it
  double wheels_rad_per_sqrt_m = 0.02;  ///< of a turn by the wheels: random walk along the path
  double wheels_rad_per_rad = 0.1;      ///< and with the turn
  double compared_s = 2.0;    ///< time over which the motion by wheels and by scans is compared
  double speed_sd_m_s = 0.3;  ///< of unobserved motion, for which the last speed is assumed
  double turn_sd_rad_s = 0.3;
  /// Walls observed before an unobserved stretch shorter than this are observed again after it.
  double unobserved_max_m = 1.0;
  int lost_max_bridged = 2;  ///< as they are after this many lost scans

  template <class V>
  void visit(V& v) {
    v("floor_m", floor_m, within(1e-4, 10.0));
    v("floor_rad", floor_rad, within(1e-5, 1.0));
    v("drift_m_per_sqrt_m", drift_m_per_sqrt_m, within(0.0, 10.0));
    v("drift_rad_per_sqrt_m", drift_rad_per_sqrt_m, within(0.0, 1.0));
    v("drift_rad_per_sqrt_rad", drift_rad_per_sqrt_rad, within(0.0, 1.0));
    v("dense_m", dense_m, above(0.0));
    v("wheels_m_per_sqrt_m", wheels_m_per_sqrt_m, within(0.0, 10.0));
    v("wheels_scale_sd", wheels_scale_sd, within(0.0, 1.0));
    v("wheels_rad_per_sqrt_m", wheels_rad_per_sqrt_m, within(0.0, 10.0));
    v("wheels_rad_per_rad", wheels_rad_per_rad, within(0.0, 10.0));
    v("compared_s", compared_s, within(0.1, 60.0));
    v("speed_sd_m_s", speed_sd_m_s, within(0.001, 100.0));
    v("turn_sd_rad_s", turn_sd_rad_s, within(0.001, 100.0));
    v("unobserved_max_m", unobserved_max_m, within(0.0, 100.0));
    v("lost_max_bridged", lost_max_bridged, within(0, 1000));
  }
};

/// The part of the error of a displacement that comes from the scale of the wheels, as far as that
/// is less known than `DisplacementErrorParams::wheels_scale_sd`: it is the same in all of them.
struct WheelScaleError {
  Eigen::Vector3d error = Eigen::Vector3d::Zero();  ///< of (x, y, θ) by one standard deviation
  double scale_sd = 0.0;                            ///< this standard deviation [m/m]
  /// The covariance of the displacement contains error · errorᵀ so many times.
  double times = 0.0;
};

/// Estimates the error of the displacement of the body over some metres by scan matching. Scan
/// matching matches each scan against the walls of many metres, so the errors of its steps mostly
/// cancel, and the sum of their covariances is not the error of the displacement. What remains is a
/// drift with path length and turns, and, in degenerate directions, the error of what replaced the
/// scan: that of the wheels, a random walk and an error of scale (Borenstein and Feng, "Measurement
/// and correction of systematic odometry errors in mobile robots", 1996); that of the gyro, assumed
/// independent from step to step; or that of an assumed speed, which is the same in all steps. The
/// scale of the wheels is the same in displacements that follow each other, which a pose graph
/// takes for independent: the k-th of a stretch that only the wheels measured has 2k - 1 times the
/// variance of one, so that the sum over the stretch is that of its whole length. A short stretch
/// of scans that are lost or degenerate without wheels leaves no error: the next good scan is
/// matched against the same walls. What the wheels filled stays: where some scans constrain a
/// direction and others do not, the former do so weakly.
///
/// Two lasers are matched each against what it saw itself. Where surfaces deceive one of them, such
/// as ground that it takes for a wall, their poses part, and later only one of them remains. Which
/// is right is unknown: the largest disagreement of a displacement adds an error of half of it.
///
/// Scans that slip claim millimetres, and wheels that slip centimetres. Over some seconds the two
/// are compared. What is more than both claim has one of them as its cause, and which is unknown:
/// half of it is added as an error, in this direction, so that both places are likely. Slips of one
/// displacement add up or cancel; the largest sum counts, as the walls in between are bent by it.
class DisplacementError {
 public:
  explicit DisplacementError(const DisplacementErrorParams& params) : params_(params) {}

  /// Starts a new displacement.
  void reset();

  /// Adds a step of the body that ends with `match`. `wheels_step`: the same by the wheels, along
  /// the ground; empty if they did not measure it.
  void add_step(const Pose2& T_last_body, const ScanMatch& match,
                const std::optional<Pose2>& wheels_step = std::nullopt);

  /// Adds the motion between two stored scans. Separate from the steps, since the pose of a
  /// standing body jitters but does not drift.
  void add_travel(double distance_m, double turn_rad);

  /// Covariance of (x, y, θ) in the present body frame [m, m, rad]. Positive definite.
  [[nodiscard]] Eigen::Matrix3d covariance() const;
  /// In the present body frame.
  [[nodiscard]] WheelScaleError wheel_scale_error() const;

 private:
  /// A covariance: the part that is independent from step to step, and the root of the part common
  /// to all steps.
  struct ErrorCovariance {
    Eigen::Matrix3d independent = Eigen::Matrix3d::Zero();
    Eigen::Matrix3d common_root = Eigen::Matrix3d::Zero();

    void move(const Eigen::Matrix3d& Ad);
    void add(const ErrorCovariance& other);
    [[nodiscard]] Eigen::Matrix3d sum() const;
  };

  [[nodiscard]] ErrorCovariance unobserved_error(const ScanMatch& match,
                                                 const std::optional<Pose2>& wheels_step) const;
  [[nodiscard]] std::optional<ErrorCovariance> carried_error(
      const ScanMatch& match, const std::optional<Pose2>& wheels_step) const;
  [[nodiscard]] ErrorCovariance unconstrained_error(const DegenerateDirection& direction,
                                                    const ScanMatch& match) const;
  /// The motion by scans compared with that by the wheels, in the present body frame.
  struct WheelComparison {
    std::int64_t begin_utime = 0;
    Eigen::Vector3d difference = Eigen::Vector3d::Zero();  ///< scans minus wheels
    ErrorCovariance wheels;                                ///< what they claim

    /// The part of the difference that both claims do not explain; zero if they explain it.
    [[nodiscard]] Eigen::Vector3d unexplained() const;
  };

  void compare_with_wheels(const Pose2& T_last_body, const ScanMatch& match,
                           const std::optional<Pose2>& wheels_step);
  [[nodiscard]] double scale_sd(const ScanMatch& match) const;
  [[nodiscard]] ErrorCovariance wheels_error(const Pose2& wheels_step, double scale_sd) const;
  void add_filled(const Pose2& T_last_body, const ScanMatch& match);
  [[nodiscard]] double scale_covariances() const;
  void end_unobserved_stretch();
  void add_disagreement(const Pose2& T_last_body, const ScanMatch& match);

  DisplacementErrorParams params_;
  ErrorCovariance accumulated_;
  ErrorCovariance unobserved_;                             ///< of the current unobserved stretch
  Eigen::Vector3d scale_error_ = Eigen::Vector3d::Zero();  ///< of the wheels, one sd of the scale
  Eigen::Vector3d earlier_scale_error_ = Eigen::Vector3d::Zero();  ///< of the stretch before it
  Eigen::Vector3d common_scale_error_ = Eigen::Vector3d::Zero();   ///< part of the first, see above
  double common_scale_sd_ = 0.0;                                   ///< the largest
  double path_m_ = 0.0;
  double filled_m_ = 0.0;  ///< of it, by the wheels
  double unobserved_m_ = 0.0;
  int unobserved_lost_ = 0;
  /// A motion from one match to the next.
  struct Step {
    std::string from_channel;
    std::string channel;
    double duration_s = 0.0;
    Pose2 T_last_body;
  };
  Step last_step_;
  Eigen::Vector3d disagreement_ = Eigen::Vector3d::Zero();  ///< the largest, in the present body
  WheelComparison comparison_;                              ///< of the last seconds
  /// Of earlier comparisons, what was not explained: their sum, in the present body.
  Eigen::Vector3d slip_ = Eigen::Vector3d::Zero();
  Eigen::Vector3d largest_slip_ = Eigen::Vector3d::Zero();  ///< the largest such sum
};

}  // namespace adit

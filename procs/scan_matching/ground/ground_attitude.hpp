// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <optional>
#include <unordered_map>
#include <vector>

#include <Eigen/Core>

#include "common/config/bounds.hpp"
#include "common/geometry/attitude.hpp"
#include "common/geometry/pose2.hpp"
#include "common/registration/cloud_registration.hpp"
#include "common/types/cloud.hpp"
#include "common/types/terrain_map.hpp"
#include "common/types/vehicle.hpp"

namespace adit {

struct GroundAttitudeParams {
  double wheel_sd_m = 0.02;      ///< of the ground under a wheel, as a 3D scan shows it
  double slope_sd_per_m = 0.15;  ///< change of the slope under the body, per root of a metre
  double level_sd_rad = 0.05;    ///< of the tilt of a 3D scan before it is matched
  double height_sd_m = 0.2;      ///< of its height above the one before
  CloudRegistrationParams registration;

  template <class V>
  void visit(V& v) {
    v("wheel_sd_m", wheel_sd_m, above(0.0));
    v("slope_sd_per_m", slope_sd_per_m, above(0.0));
    v("level_sd_rad", level_sd_rad, above(0.0));
    v("height_sd_m", height_sd_m, above(0.0));
    v("registration", registration);
  }
};

/// Roll, pitch and height of a body without an IMU: those of the ground under its wheels, as the
/// last 3D scans showed it. The plane on which the body stands is estimated by a Kalman filter from
/// the heights under the wheels. Each 3D scan is matched to the one before in six degrees of
/// freedom, so that tilt and height of a scan do not depend on the ground in between. Where the
/// first 3D scan is made the body counts as level.
class GroundAttitude {
 public:
  /// Where the level frame of a 3D scan lies: its height in odom rises by slope · p [m/m] along its
  /// axes, since it was levelled by an estimate.
  struct Level {
    double z_odom_m = 0.0;
    Eigen::Vector2d slope = Eigen::Vector2d::Zero();
  };

  GroundAttitude(const GroundAttitudeParams& params, const Vehicle& vehicle)
      : params_(params), vehicle_(vehicle) {}

  /// A 3D scan from where the body stands at this height, levelled by attitude(). Corrects attitude
  /// and height.
  void add(const Cloud& cloud, double z_odom_m);
  /// The terrain map of a 3D scan; corrects attitude and height by the ground that is remembered,
  /// and returns where the map lies.
  Level add(const TerrainMap& terrain, double z_odom_m);
  /// The pose of the body after a step of about 0.1 m.
  void drive(const Pose2& T_odom_body);
  /// Forgets everything, since an IMU measures the attitude.
  void clear();

  /// Nothing before the first 3D scan.
  [[nodiscard]] std::optional<Attitude> attitude(double heading_rad) const;
  /// Height of the body in odom; nothing before the first 3D scan.
  [[nodiscard]] std::optional<double> z_odom_m() const;

 private:
  struct Plane {
    Pose2 T_odom_body;
    /// Height of the body's origin, and slope of the ground along x and y of odom.
    Eigen::Vector3d state = Eigen::Vector3d::Zero();
    Eigen::Matrix3d covariance = Eigen::Matrix3d::Zero();
  };
  struct PlacedCloud {
    RegistrationCloud surfaces;
    std::int64_t utime = 0;
    Pose2 T_odom_level;
    double z_odom_m = 0.0;
    Eigen::Vector3d up_level = Eigen::Vector3d::UnitZ();  ///< the vertical, in level
  };

  void match(PlacedCloud& cloud) const;
  [[nodiscard]] Eigen::Vector3d to_remembered(const std::vector<Eigen::Vector3d>& points,
                                              const Pose2& T_odom_level, const Level& level) const;
  [[nodiscard]] std::optional<double> ground_m(const Eigen::Vector2d& p_odom) const;

  GroundAttitudeParams params_;
  Vehicle vehicle_;
  std::optional<Plane> plane_;
  std::optional<PlacedCloud> last_;
  std::unordered_map<std::uint64_t, float> ground_m_;  ///< height in odom, by cell
};

}  // namespace adit

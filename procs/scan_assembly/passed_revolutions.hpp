// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <deque>
#include <optional>
#include <vector>

#include "common/config/bounds.hpp"
#include "common/geometry/attitude.hpp"
#include "common/geometry/pose2.hpp"
#include "common/sensing/laser_mount.hpp"
#include "common/sensing/spinning_lidar.hpp"
#include "common/types/cloud.hpp"
#include "procs/scan_assembly/mixed_pixels.hpp"

namespace adit {

struct PassedRevolutionsParams {
  int count = 16;            ///< kept, the newest; 0: none
  double spacing_m = 0.25;   ///< one is kept after this motion,
  double spacing_rad = 0.2;  ///< or this turn

  template <class V>
  void visit(V& v) {
    v("count", count, within(0, 100));
    v("spacing_m", spacing_m, above(0.0));
    v("spacing_rad", spacing_rad, above(0.0));
  }
};

/// Revolutions of a spinning lidar that were made while the robot drove to the place of a 3D scan.
/// Between the rings of a robot that stands the ground is not seen, and none of it near the body;
/// from places 0.25 m apart the rings lie close together. They are placed by the poses at their
/// time, with height and attitude, which an IMU must measure: over 4 m, POSE errs by about
/// 1 cm in height and 5 mrad in roll and pitch. Revolutions during which the attitude changes
/// fast, as on a stone, are left out.
class PassedRevolutions {
 public:
  struct BodyPose {
    std::int64_t utime = 0;
    Pose2 T_odom_body;
    double z_odom_m = 0.0;
    Attitude attitude;
  };

  PassedRevolutions(const PassedRevolutionsParams& params, const Lasers& lasers,
                    const MixedPixelParams& mixed_pixels)
      : params_(params), lasers_(lasers), mixed_pixels_(mixed_pixels) {}

  /// Poses and revolutions in order of time; a revolution is placed once there is a pose at its
  /// end. A step back in time, or one that no robot can make, begins again: odom is another.
  void add(const BodyPose& pose);
  void add(const LidarRevolution& revolution);

  /// Their lines in a frame level, oldest revolution first.
  [[nodiscard]] std::vector<CloudLine> lines(const Pose2& T_odom_level, double z_odom_m) const;
  /// Each belongs to one 3D scan: two that share readings would match by them.
  void clear() { kept_.clear(); }

 private:
  /// The lines of one revolution, level at the pose of the body at its end.
  struct Kept {
    BodyPose pose;
    std::vector<CloudLine> lines;
  };

  [[nodiscard]] bool is_due() const;
  void place_pending();

  PassedRevolutionsParams params_;
  Lasers lasers_;
  MixedPixelParams mixed_pixels_;
  std::deque<BodyPose> poses_;        ///< of the last second
  std::optional<Pose2> T_odom_last_;  ///< where the last one was taken, or the first pose
  std::optional<LidarRevolution> pending_;
  std::deque<Kept> kept_;
};

}  // namespace adit

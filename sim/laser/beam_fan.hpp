// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <functional>
#include <span>
#include <vector>

#include <Eigen/Geometry>

#include "sim/laser/laser_params.hpp"
#include "sim/mesh/ray_scene.hpp"

namespace adit {

/// The rays of a scan: those of one beam side by side, beams from −90° to 90°, each from where the
/// laser is at its own time. A beam of nine has one in the middle and eight around it.
class BeamFan {
 public:
  /// Pose of the laser in world, some seconds after the first beam of a scan.
  using PoseAt = std::function<Eigen::Isometry3d(double seconds)>;

  /// Throws std::invalid_argument for sub-rays that are neither 1 nor 9.
  explicit BeamFan(const LaserParams& params);

  /// In world. Asks for the pose some times in each turn of the mirror and interpolates between: at
  /// 10 rad/s what is 80 m away is 0.3 mm off. Valid until the next call.
  const std::vector<Ray>& rays(const PoseAt& T_world_laser);

 private:
  struct BeamTime {
    std::size_t knot = 0;  ///< the one before the beam
    double share = 0.0;    ///< of the way from it to the next, 0 to 1
  };

  void add_knots(int turn, double mirror_hz);
  void add_beam_time(int turn, double share_of_half_turn);

  std::size_t subrays_;
  std::vector<double> knot_times_s_;  ///< when the pose is asked for
  std::vector<BeamTime> beam_times_;
  std::vector<Ray> rays_laser_;  ///< in the laser's frame
  std::vector<Ray> rays_world_;
};

}  // namespace adit

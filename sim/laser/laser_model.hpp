// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <functional>
#include <random>
#include <vector>

#include <Eigen/Geometry>

#include "common/sensing/laser_scan.hpp"
#include "sim/laser/laser_params.hpp"
#include "sim/laser/range_finder.hpp"
#include "sim/mesh/ray_scene.hpp"

namespace adit {

/// The rays of a scan, grouped by beam, over the field of view, each from the pose of the laser at
/// the time of its beam. A beam of nine rays has one in the centre and eight around it.
class BeamFan {
 public:
  /// T_world_laser at a time after the first beam of a scan [s].
  using PoseAt = std::function<Eigen::Isometry3d(double seconds)>;

  /// Throws std::invalid_argument unless `subrays` is 1 or 9.
  explicit BeamFan(const LaserParams& params);

  /// The rays in world. The pose is evaluated at knots in each turn of the mirror and interpolated
  /// between them: at 10 rad/s and 80 m the error is 0.3 mm. Valid until the next call.
  const std::vector<Ray>& rays(const PoseAt& T_world_laser);

 private:
  struct BeamTime {
    std::size_t knot = 0;  ///< the knot before the beam
    double share = 0.0;    ///< from this knot to the next, 0 to 1
  };

  void add_knots(int turn, const LaserParams& params);
  void add_beam_time(int turn, double share_of_view);

  std::size_t subrays_;
  int intervals_;                     ///< between the knots of a turn
  std::vector<double> knot_times_s_;  ///< where the pose is evaluated
  std::vector<BeamTime> beam_times_;
  std::vector<Ray> rays_laser_;  ///< in the laser's frame
  std::vector<Ray> rays_world_;
};

/// Simulates the scans of one laser. Each laser has its own random stream: the same seed and the
/// same calls give the same scans. Beams run counter-clockwise over the field of view.
class LaserModel {
 public:
  /// T_world_laser at a time after the first beam of a scan [s].
  using PoseAt = BeamFan::PoseAt;

  /// `scene` must outlive this. Throws std::invalid_argument unless `subrays` is 1 or 9.
  LaserModel(const RayScene& scene, const LaserParams& params, std::uint64_t seed);

  /// The scan whose first beam is at `utime`. Each beam starts at the pose of the laser at its own
  /// time (ScanTiming).
  LaserScan measure(const PoseAt& T_world_laser, std::int64_t utime);

  /// Systematic range error, drawn once within ±LaserParams::offset_max_m.
  [[nodiscard]] double offset_m() const { return offset_m_; }

 private:
  const RayScene& scene_;
  LaserParams params_;
  RangeFinder finder_;
  std::mt19937_64 random_;
  std::normal_distribution<double> normal_;
  double offset_m_ = 0.0;
  BeamFan fan_;
  std::vector<RayHit> hits_;
};

}  // namespace adit

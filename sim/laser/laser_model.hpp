// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <optional>
#include <random>
#include <span>
#include <vector>

#include "common/sensing/laser_scan.hpp"
#include "sim/laser/beam_fan.hpp"
#include "sim/laser/echo.hpp"
#include "sim/laser/laser_params.hpp"
#include "sim/mesh/ray_scene.hpp"

namespace adit {

/// Makes the scans of one laser, with a stream of noise of its own: the same seed and the same
/// calls give the same scans. Beams run counter-clockwise from −90° to 90°.
class LaserModel {
 public:
  /// Pose of the laser in world, some seconds after the first beam of a scan.
  using PoseAt = BeamFan::PoseAt;

  /// `scene` must outlive this. Throws std::invalid_argument for sub-rays that are neither 1 nor 9.
  LaserModel(const RayScene& scene, const LaserParams& params, std::uint64_t seed);

  /// The scan whose first beam is at `utime`. Each beam starts from where the laser is at its own
  /// time (ScanTiming).
  LaserScan measure(const PoseAt& T_world_laser, std::int64_t utime);

  /// Drawn once, in the bounds of LaserParams::offset_max_m [m].
  [[nodiscard]] double offset_m() const { return offset_m_; }

 private:
  [[nodiscard]] std::optional<Echo> echo(const Ray& ray, const RayHit& hit) const;
  [[nodiscard]] std::optional<Echo> mirrored_echo(const Ray& ray, const RayHit& hit) const;
  [[nodiscard]] std::optional<double> range_m(std::span<const Ray> rays,
                                              std::span<const RayHit> hits) const;
  [[nodiscard]] float reading_m(std::optional<double> range_m, double noise_m) const;

  const RayScene& scene_;
  LaserParams params_;
  std::mt19937_64 random_;
  std::normal_distribution<double> normal_;
  double offset_m_ = 0.0;
  double power_min_ = 0.0;     ///< that is seen, of the mean of the sub-rays
  float ray_length_m_ = 0.0F;  ///< beyond which nothing is seen
  BeamFan fan_;
  std::vector<RayHit> hits_;
};

}  // namespace adit

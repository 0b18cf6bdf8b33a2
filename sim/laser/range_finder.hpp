// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <span>

#include "sim/laser/echo.hpp"
#include "sim/laser/laser_params.hpp"
#include "sim/mesh/ray_scene.hpp"

namespace adit {

/// What a laser measures along one beam, from the surfaces that its rays hit.
class RangeFinder {
 public:
  /// `scene` must outlive this.
  RangeFinder(const RayScene& scene, const LaserParams& params);

  /// Range of the echo of one beam, `params.subrays` rays; nothing if it is too weak.
  [[nodiscard]] std::optional<double> range_m(std::span<const Ray> rays,
                                              std::span<const RayHit> hits) const;
  /// The reading for a range with its error, in the laser's resolution; that for no return if there
  /// is none or it is too near.
  [[nodiscard]] float reading_m(std::optional<double> range_m, double error_m) const;

  /// Greatest range at which anything is detected.
  [[nodiscard]] float ray_length_m() const { return ray_length_m_; }

 private:
  [[nodiscard]] std::optional<Echo> echo(const Ray& ray, const RayHit& hit) const;
  [[nodiscard]] std::optional<Echo> specular_echo(const Ray& ray, const RayHit& hit) const;

  const RayScene& scene_;
  LaserParams params_;
  double power_min_ = 0.0;  ///< detection threshold of the mean power of the sub-rays
  float ray_length_m_ = 0.0F;
};

}  // namespace adit

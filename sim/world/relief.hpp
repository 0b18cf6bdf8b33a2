// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <vector>

#include <Eigen/Core>

#include "sim/noise/smooth_noise.hpp"
#include "sim/world/world_description.hpp"

namespace adit {

/// Smooth noise in octaves, as a ReliefDescription says: a function of the plane and one of space,
/// both within ± its height [m].
class Relief {
 public:
  Relief(const ReliefDescription& description, std::uint64_t seed);

  double operator()(const Eigen::Vector2d& p_world) const;
  [[nodiscard]] double in_space(const Eigen::Vector3d& p_world) const;

 private:
  struct Octave {
    SmoothNoise noise;
    double height_m = 0.0;
    double length_m = 1.0;
  };
  std::vector<Octave> octaves_;  ///< none without height
};

}  // namespace adit

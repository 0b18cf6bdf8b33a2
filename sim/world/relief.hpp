// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <vector>

#include <Eigen/Core>

#include "sim/noise/smooth_noise.hpp"
#include "sim/world/world_description.hpp"

namespace adit {

/// The reliefs of one world, which are independent of each other.
enum class ReliefKind : std::uint64_t {
  kFloor = 1,
  kRoof = 2,
  kWallInPlan = 3,
  kWallInHeight = 4,
  kRolls = 5,
};

/// The seed of a relief, from that of its world.
inline std::uint64_t relief_seed(int world_seed, ReliefKind relief) {
  return static_cast<std::uint64_t>(world_seed) * 16U + static_cast<std::uint64_t>(relief);
}

/// Sum of octaves of smooth noise (ReliefDescription): a function of the plane and one of space,
/// both within ± height_m [m].
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
  template <class Point>
  [[nodiscard]] Point repeated(Point p_world) const;

  std::vector<Octave> octaves_;  ///< empty without height
  double repeat_y_m_ = 0.0;
};

}  // namespace adit

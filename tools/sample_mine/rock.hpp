// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <functional>
#include <vector>

#include <Eigen/Core>

#include "sim/noise/smooth_noise.hpp"

namespace adit {

/// A straight piece of a working; a room where both ends are the same.
struct Working {
  Eigen::Vector2d from;
  Eigen::Vector2d to;
  double half_width_m;
};

struct Pillar {
  Eigen::Vector2d centre;
  double radius_m;
};

/// Where the rough walls of a place take their pattern from: places that it sends to one have the
/// same walls. Continuous where there is a wall.
using Pattern = std::function<Eigen::Vector2d(const Eigen::Vector2d&)>;

/// Makes smooth walls rough, by about half a metre, from the seed.
class Roughness {
 public:
  explicit Roughness(std::uint64_t seed) : coarse_(seed + 1), fine_(seed + 2) {}

  /// How far inside the rock a point lies that would be `depth_m` behind a smooth wall.
  double operator()(double depth_m, const Eigen::Vector2d& place) const {
    if (depth_m > 1.0) return depth_m;  // it does not reach that far
    return depth_m + 0.40 * coarse_(place / 2.2) + 0.20 * fine_(place / 0.7);
  }

 private:
  SmoothNoise coarse_;
  SmoothNoise fine_;
};

/// How far inside the rock a point lies [m]; negative in the open.
class Rock {
 public:
  Rock(
      std::vector<Working> workings, std::vector<Pillar> pillars, std::uint64_t seed,
      Pattern pattern = [](const Eigen::Vector2d& p) { return p; });

  double operator()(const Eigen::Vector2d& p) const;

 private:
  std::vector<Working> workings_;
  std::vector<Pillar> pillars_;
  Roughness roughness_;
  Pattern pattern_;
};

}  // namespace adit

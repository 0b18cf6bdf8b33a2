// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>

#include <Eigen/Core>

namespace adit {

/// A smooth random function of the plane, and one of space, between −1 and 1, that vary over about
/// one unit: random values on the corners of unit squares or cubes, blended between them (value
/// noise). It has no memory: the value of a corner is a hash of the seed and where the corner is.
class SmoothNoise {
 public:
  explicit SmoothNoise(std::uint64_t seed) : seed_(seed) {}

  double operator()(const Eigen::Vector2d& p) const;
  /// The one of space.
  [[nodiscard]] double in_space(const Eigen::Vector3d& p) const;

 private:
  std::uint64_t seed_;
};

}  // namespace adit

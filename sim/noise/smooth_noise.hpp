// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>

#include <Eigen/Core>

namespace adit {

/// Value noise of the plane and of space, between −1 and 1, with a correlation length of about one
/// unit: random values at the corners of unit squares or cubes, interpolated between them.
/// Stateless: the value of a corner is a hash of the seed and the corner's indices.
class SmoothNoise {
 public:
  explicit SmoothNoise(std::uint64_t seed) : seed_(seed) {}

  double operator()(const Eigen::Vector2d& p) const;
  /// The noise of space.
  [[nodiscard]] double in_space(const Eigen::Vector3d& p) const;

 private:
  std::uint64_t seed_;
};

}  // namespace adit

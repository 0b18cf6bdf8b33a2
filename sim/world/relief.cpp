// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "sim/world/relief.hpp"

#include <cmath>

namespace adit {

Relief::Relief(const ReliefDescription& description, std::uint64_t seed) {
  repeat_y_m_ = description.repeat_y_m;
  if (description.height_m == 0.0) return;
  const double sum_of_shares = 2.0 - std::ldexp(1.0, 1 - description.octaves);
  for (int i = 0; i < description.octaves; ++i) {
    // Distinct seeds, so that no octave of one relief equals that of another.
    const std::uint64_t own_seed = (seed << 8U) + static_cast<std::uint64_t>(i);
    octaves_.push_back({SmoothNoise(own_seed), std::ldexp(description.height_m / sum_of_shares, -i),
                        std::ldexp(description.length_m, -i)});
  }
}

/// The point of the first period, from -repeat_y_m/2 to repeat_y_m/2, that has the same relief.
template <class Point>
Point Relief::repeated(Point p_world) const {
  if (repeat_y_m_ > 0.0) p_world.y() -= repeat_y_m_ * std::round(p_world.y() / repeat_y_m_);
  return p_world;
}

double Relief::operator()(const Eigen::Vector2d& p_world) const {
  const Eigen::Vector2d p = repeated(p_world);
  double height = 0.0;
  for (const Octave& octave : octaves_) {
    height += octave.height_m * octave.noise(p / octave.length_m);
  }
  return height;
}

double Relief::in_space(const Eigen::Vector3d& p_world) const {
  const Eigen::Vector3d p = repeated(p_world);
  double height = 0.0;
  for (const Octave& octave : octaves_) {
    height += octave.height_m * octave.noise.in_space(p / octave.length_m);
  }
  return height;
}

}  // namespace adit

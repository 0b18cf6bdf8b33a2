// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "tools/sample_mine/smooth_noise.hpp"

#include <cmath>

namespace adit {
namespace {

double ease(double t) { return t * t * (3.0 - 2.0 * t); }

/// The finaliser of SplitMix64 (Steele et al. 2014).
std::uint64_t mix(std::uint64_t z) {
  z = (z ^ (z >> 30U)) * 0xbf58476d1ce4e5b9U;
  z = (z ^ (z >> 27U)) * 0x94d049bb133111ebU;
  return z ^ (z >> 31U);
}

}  // namespace

double SmoothNoise::operator()(const Eigen::Vector2d& p) const {
  const double x = std::floor(p.x());
  const double y = std::floor(p.y());
  const auto i = static_cast<std::int64_t>(x);
  const auto j = static_cast<std::int64_t>(y);
  const double u = ease(p.x() - x);
  const double v = ease(p.y() - y);
  const double low = std::lerp(corner(i, j), corner(i + 1, j), u);
  const double high = std::lerp(corner(i, j + 1), corner(i + 1, j + 1), u);
  return std::lerp(low, high, v);
}

double SmoothNoise::corner(std::int64_t x, std::int64_t y) const {
  const std::uint64_t row = mix(seed_ + 0x9e3779b97f4a7c15U * static_cast<std::uint64_t>(y));
  const std::uint64_t hash = mix(row + 0x9e3779b97f4a7c15U * static_cast<std::uint64_t>(x));
  return std::ldexp(static_cast<double>(hash >> 11U), -52) - 1.0;
}

}  // namespace adit

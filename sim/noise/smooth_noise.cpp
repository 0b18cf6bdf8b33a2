// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "sim/noise/smooth_noise.hpp"

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

constexpr std::uint64_t kGolden = 0x9e3779b97f4a7c15U;

/// A value between −1 and 1 for the 53 upper bits.
double to_value(std::uint64_t hash) {
  return std::ldexp(static_cast<double>(hash >> 11U), -52) - 1.0;
}

std::uint64_t step(std::uint64_t hash, std::int64_t index) {
  return mix(hash + kGolden * static_cast<std::uint64_t>(index));
}

/// Interpolates along x between two corners of the row with this hash.
double along_x(std::uint64_t row, std::int64_t i, double u) {
  return std::lerp(to_value(step(row, i)), to_value(step(row, i + 1)), u);
}

double in_plane(std::uint64_t seed, const Eigen::Vector2d& p) {
  const double x = std::floor(p.x());
  const double y = std::floor(p.y());
  const auto i = static_cast<std::int64_t>(x);
  const auto j = static_cast<std::int64_t>(y);
  const double u = ease(p.x() - x);
  const double low = along_x(step(seed, j), i, u);
  const double high = along_x(step(seed, j + 1), i, u);
  return std::lerp(low, high, ease(p.y() - y));
}

}  // namespace

double SmoothNoise::operator()(const Eigen::Vector2d& p) const { return in_plane(seed_, p); }

double SmoothNoise::in_space(const Eigen::Vector3d& p) const {
  const double z = std::floor(p.z());
  const auto k = static_cast<std::int64_t>(z);
  const double low = in_plane(step(seed_, k), p.head<2>());
  const double high = in_plane(step(seed_, k + 1), p.head<2>());
  return std::lerp(low, high, ease(p.z() - z));
}

}  // namespace adit

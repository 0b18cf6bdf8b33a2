// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "procs/planning/c_space/heading_set.hpp"

#include <cmath>
#include <numbers>
#include <stdexcept>

#include "common/geometry/pose2.hpp"

namespace adit {
namespace {

// Maximum deviation of a heading from equal spacing, as a share of the spacing.
constexpr double kDeviationMaxShare = 0.125;

/// The shortest vector of whole cells near an angle in [0, π/4].
Eigen::Vector2i short_vector(double angle, double gap) {
  for (int x = 1;; ++x) {
    Eigen::Vector2i v(x, static_cast<int>(std::lround(x * std::tan(angle))));
    if (std::abs(std::atan2(v.y(), v.x()) - angle) <= kDeviationMaxShare * gap) return v;
  }
}

}  // namespace

HeadingSet::HeadingSet(int count) {
  if (count < 8 || count > 128 || count % 8 != 0) {
    throw std::invalid_argument("the number of headings must be a multiple of 8 from 8 to 128");
  }
  const double gap = 2.0 * std::numbers::pi / count;
  for (int k = 0; k <= count / 8; ++k) directions_.push_back(short_vector(k * gap, gap));
  for (int k = count / 8 + 1; k < count / 4; ++k) {
    const auto mirrored = directions_[static_cast<std::size_t>(count / 4 - k)];
    directions_.emplace_back(mirrored.y(), mirrored.x());
  }
  for (int k = count / 4; k < count; ++k) {
    const auto turned = directions_[static_cast<std::size_t>(k - count / 4)];
    directions_.emplace_back(-turned.y(), turned.x());
  }
}

double HeadingSet::angle(int heading) const {
  const Eigen::Vector2i& v = direction(heading);
  return std::atan2(v.y(), v.x());
}

double HeadingSet::half_gap(int heading) const {
  return std::abs(angle_diff(angle(wrapped(heading + 1)), angle(heading))) / 2.0;
}

int HeadingSet::nearest(double angle_rad) const {
  const double gap = 2.0 * std::numbers::pi / count();
  const int guess = wrapped(static_cast<int>(std::lround(wrap_angle(angle_rad) / gap)));
  int best = guess;
  for (const int k : {wrapped(guess - 1), wrapped(guess + 1)}) {
    const double off = std::abs(angle_diff(angle(k), angle_rad));
    if (off < std::abs(angle_diff(angle(best), angle_rad))) best = k;
  }
  return best;
}

}  // namespace adit

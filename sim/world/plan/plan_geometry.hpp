// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>

#include <Eigen/Core>

#include "common/geometry/segment.hpp"

namespace adit {

/// Position of the point nearest to `p` on the segment from `a` to `b`: 0 at `a`, 1 at `b`; 0 for a
/// segment without length.
inline double nearest_share(const Eigen::Vector2d& p, const Eigen::Vector2d& a,
                            const Eigen::Vector2d& b) {
  const Eigen::Vector2d along = b - a;
  const double square = along.squaredNorm();
  return square > 0.0 ? std::clamp((p - a).dot(along) / square, 0.0, 1.0) : 0.0;
}

inline double distance_to_segment(const Eigen::Vector2d& p, const Eigen::Vector2d& a,
                                  const Eigen::Vector2d& b) {
  return (p - a - nearest_share(p, a, b) * (b - a)).norm();
}

}  // namespace adit

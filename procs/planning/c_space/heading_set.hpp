// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include <Eigen/Core>

namespace adit {

/// The headings of the lattice: about equally spaced, but each is the angle of a short vector of
/// whole cells, so that the robot can drive straight on from one cell's middle to another's. The
/// set is the same when it is mirrored or turned by a right angle, exactly.
class HeadingSet {
 public:
  /// Throws std::invalid_argument unless `count` is a multiple of 8 from 8 to 128.
  explicit HeadingSet(int count);

  [[nodiscard]] int count() const { return static_cast<int>(directions_.size()); }
  [[nodiscard]] int wrapped(int heading) const { return (heading % count() + count()) % count(); }
  /// In cells; heading 0 is along x, and they count counter-clockwise.
  [[nodiscard]] const Eigen::Vector2i& direction(int heading) const {
    return directions_[static_cast<std::size_t>(heading)];
  }
  [[nodiscard]] double angle(int heading) const;  ///< in (−π, π] [rad]
  /// To the middle between this heading and the next one counter-clockwise. [rad]
  [[nodiscard]] double half_gap(int heading) const;
  [[nodiscard]] int nearest(double angle_rad) const;

 private:
  std::vector<Eigen::Vector2i> directions_;
};

}  // namespace adit

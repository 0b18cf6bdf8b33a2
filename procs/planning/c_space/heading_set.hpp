// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include <Eigen/Core>

namespace adit {

/// The discrete headings of the lattice. They are about equally spaced, but each is the angle of a
/// short vector of whole cells, so that a straight drive leads from the centre of a cell to the
/// centre of another. The set is exactly symmetric under reflection and rotation by π/2.
class HeadingSet {
 public:
  /// Throws std::invalid_argument unless `count` is a multiple of 8 from 8 to 128.
  explicit HeadingSet(int count);

  [[nodiscard]] int count() const { return static_cast<int>(directions_.size()); }
  /// A heading index modulo the count.
  [[nodiscard]] int wrapped(int heading) const { return (heading % count() + count()) % count(); }
  /// The vector of a heading [cells]. Heading 0 is along x; headings increase counter-clockwise.
  [[nodiscard]] const Eigen::Vector2i& direction(int heading) const {
    return directions_[static_cast<std::size_t>(heading)];
  }
  [[nodiscard]] double angle(int heading) const;  ///< in (−π, π] [rad]
  /// Half the angle between a heading and the next one counter-clockwise [rad].
  [[nodiscard]] double half_gap(int heading) const;
  [[nodiscard]] int nearest(double angle_rad) const;

 private:
  std::vector<Eigen::Vector2i> directions_;
};

}  // namespace adit

// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "common/geometry/ring.hpp"

namespace adit {

bool encloses(const std::vector<Eigen::Vector2d>& ring, const Eigen::Vector2d& p) {
  bool inside = false;
  for (std::size_t i = 0; i < ring.size(); ++i) {
    const Eigen::Vector2d& a = ring[i];
    const Eigen::Vector2d& b = ring[i + 1 < ring.size() ? i + 1 : 0];
    if ((a.y() > p.y()) == (b.y() > p.y())) continue;
    const double x = a.x() + (b.x() - a.x()) * (p.y() - a.y()) / (b.y() - a.y());
    if (p.x() < x) inside = !inside;
  }
  return inside;
}

}  // namespace adit

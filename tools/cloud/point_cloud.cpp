// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "tools/cloud/point_cloud.hpp"

#include <stdexcept>
#include <string>

namespace adit {

void PointCloud::add(const Eigen::Vector3d& p) {
  const bool plausible = p.allFinite() && p.cwiseAbs().maxCoeff() <= kCoordinateMaxM;
  if (!plausible) {
    ++skipped;
    return;
  }
  if (points.size() == kPointsMax) reserve(kPointsMax + 1);
  points.push_back(p);
}

void PointCloud::reserve(std::size_t count) {
  if (count > kPointsMax) {
    throw std::runtime_error("more than " + std::to_string(kPointsMax / 1'000'000) +
                             " million points: thin it out first");
  }
  points.reserve(count);
}

}  // namespace adit

// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include <Eigen/Core>

namespace adit {

/// The points of a file, in its own frame [m].
struct PointCloud {
  static constexpr std::size_t kPointsMax = 20'000'000;  ///< more are refused
  static constexpr double kCoordinateMaxM = 1e5;         ///< to either side

  std::vector<Eigen::Vector3d> points;
  std::size_t skipped = 0;                ///< not finite, or farther away than plausible
  std::optional<Eigen::Vector3d> sensor;  ///< from where they were seen, where the file says it

  /// Keeps the point, or counts it among those that were skipped.
  void add(const Eigen::Vector3d& p);
  /// Room for as many, or std::runtime_error where these are more than the most.
  void reserve(std::size_t count);
};

}  // namespace adit

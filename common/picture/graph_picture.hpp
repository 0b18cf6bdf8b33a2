// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include <Eigen/Core>

#include "common/geometry/pose2.hpp"

namespace adit {

/// A pose graph to be drawn over a map, in the map's frame.
struct GraphPicture {
  struct Edge {
    Eigen::Vector2d a;  ///< [m]
    Eigen::Vector2d b;  ///< [m]
  };

  std::vector<Pose2> nodes;      ///< T_map_local, small dots
  std::vector<Edge> sequential;  ///< between consecutive local maps, thin
  std::vector<Edge> closures;    ///< in force
  std::vector<Edge> revoked;     ///< once in force and given up, dashed

  [[nodiscard]] bool empty() const {
    return nodes.empty() && sequential.empty() && closures.empty() && revoked.empty();
  }
};

}  // namespace adit

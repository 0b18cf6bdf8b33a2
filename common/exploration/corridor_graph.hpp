// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <vector>

#include <Eigen/Core>

namespace adit {

/// A place where corridors meet or end, in map.
struct CorridorNode {
  enum class Kind : std::int8_t {
    kJunction = 0,
    kDeadEnd = 1,
    kOpenEnd = 2,
  };

  Eigen::Vector2d p_map{0.0, 0.0};
  Kind kind = Kind::kJunction;

  friend bool operator==(const CorridorNode&, const CorridorNode&) = default;
};

/// A stretch of corridor between two nodes.
struct Corridor {
  int from = 0;  ///< index of a node
  int to = 0;
  double length_m = 0.0;
  double width_m = 0.0;                 ///< the least, from wall to wall
  std::vector<Eigen::Vector2d> points;  ///< p_map, from node to node

  friend bool operator==(const Corridor&, const Corridor&) = default;
};

/// The middles of what can be driven, as a graph.
struct CorridorGraph {
  std::vector<CorridorNode> nodes;
  std::vector<Corridor> corridors;

  [[nodiscard]] double length_m() const {
    double length = 0.0;
    for (const Corridor& corridor : corridors) length += corridor.length_m;
    return length;
  }

  friend bool operator==(const CorridorGraph&, const CorridorGraph&) = default;
};

}  // namespace adit

// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include <Eigen/Core>

#include "sim/world/world_description.hpp"

namespace adit {

/// The middle of one drift, in world.
struct TunnelLine {
  /// A place along it.
  struct Station {
    Eigen::Vector2d p_world{0.0, 0.0};  ///< [m]
    double heading_rad = 0.0;           ///< of the line there
  };

  /// A place as a drift counts it.
  struct Place {
    double s_m = 0.0;       ///< along the line, from its first point
    double across_m = 0.0;  ///< to the left of it
  };

  std::string name;
  std::vector<Eigen::Vector2d> points;  ///< p_world [m], at least two
  double width_m = 3.0;
  bool entrance = false;  ///< the first point is open to the outside

  [[nodiscard]] double length_m() const;
  /// `s_m` counts from the first point; before the start and behind the end, that end.
  [[nodiscard]] Station at(double s_m) const;
  /// `across_m` to the left of the middle at `s_m`.
  [[nodiscard]] Eigen::Vector2d beside(double s_m, double across_m) const;
  /// By the place on the line that is nearest. Beyond an end `s_m` is that of the end.
  [[nodiscard]] Place place_of(const Eigen::Vector2d& p_world) const;
  /// From the place on the line that is nearest.
  [[nodiscard]] double distance_m(const Eigen::Vector2d& p_world) const;
  /// Whether a place is in the drift as planned, or on its wall, by a centimetre.
  [[nodiscard]] bool contains(const Eigen::Vector2d& p_world) const;
};

/// All drifts of a plan, those of its panels included. Throws std::invalid_argument, naming the
/// drift, for fewer than two points, an odd list, a line of no length, or a name that comes twice.
std::vector<TunnelLine> tunnel_lines(const PlanDescription& plan);

/// Throws std::invalid_argument with `what` and the names that there are.
const TunnelLine& find_tunnel(const std::vector<TunnelLine>& tunnels, const std::string& name,
                              const std::string& what);

}  // namespace adit

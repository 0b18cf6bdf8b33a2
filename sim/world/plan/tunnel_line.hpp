// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include <Eigen/Core>

#include "sim/world/world_description.hpp"

namespace adit {

/// The points of a list x, y, x, y, .. Throws std::invalid_argument, beginning with `what`, for an
/// odd list, one of fewer than `least` points, or one with a number that is not finite.
std::vector<Eigen::Vector2d> corner_list(const std::vector<double>& numbers, std::size_t least,
                                         const std::string& what);

/// The centre line of one tunnel, in world.
struct TunnelLine {
  /// Position and heading at a distance along the line.
  struct Station {
    Eigen::Vector2d p_world{0.0, 0.0};  ///< [m]
    double heading_rad = 0.0;           ///< of the line there
  };

  /// Position relative to the line.
  struct Place {
    double s_m = 0.0;       ///< along the line, from its first point
    double across_m = 0.0;  ///< to the left of the line
  };

  std::string name;
  std::vector<Eigen::Vector2d> points;  ///< p_world [m], at least two
  double width_m = 3.0;
  bool entrance = false;              ///< the first point is open to the outside
  std::vector<double> rise_m = {};    ///< as in TunnelDescription
  std::string rise_grade = "smooth";  ///< of rise_m: smooth or sudden
  int level = 0;                      ///< as in TunnelDescription

  [[nodiscard]] double length_m() const;
  /// `s_m` is the distance from the first point, clamped to the ends.
  [[nodiscard]] Station at(double s_m) const;
  /// The point `across_m` to the left of the line at `s_m`.
  [[nodiscard]] Eigen::Vector2d beside(double s_m, double across_m) const;
  /// Relative to the nearest point of the line; `s_m` is clamped to the ends.
  [[nodiscard]] Place place_of(const Eigen::Vector2d& p_world) const;
  /// Distance to the nearest point of the line.
  [[nodiscard]] double distance_m(const Eigen::Vector2d& p_world) const;
  /// Whether a point is in the tunnel as planned, or on its wall within 1 cm.
  [[nodiscard]] bool contains(const Eigen::Vector2d& p_world) const;
};

/// All tunnels of a plan, including those of its panels. Throws std::invalid_argument with the name
/// of the tunnel for fewer than two points, an odd list, a line without length, or a duplicate
/// name.
std::vector<TunnelLine> tunnel_lines(const PlanDescription& plan);

/// Throws std::invalid_argument with `what` and the known names if there is no such tunnel.
const TunnelLine& find_tunnel(const std::vector<TunnelLine>& tunnels, const std::string& name,
                              const std::string& what);

}  // namespace adit

// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include <Eigen/Core>

#include "sim/world/plan/tunnel_line.hpp"

namespace adit {

/// Name of a prop as in the world file: `props.posts[2]`.
inline std::string prop_name(const std::string& list, std::size_t index) {
  return "props." + list + "[" + std::to_string(index) + "]";
}

/// The tunnel of a prop. Throws std::invalid_argument, starting with `what`, if there is no such
/// tunnel or `at_m` is not along it.
const TunnelLine& tunnel_with(const std::vector<TunnelLine>& tunnels, const std::string& name,
                              double at_m, const std::string& what);

/// The same for a section, whose end must not be before its start.
const TunnelLine& tunnel_with(const std::vector<TunnelLine>& tunnels, const std::string& name,
                              double from_m, double to_m, const std::string& what);

/// Positions along a section, including its ends, at most `step_m` apart [m].
std::vector<double> places_between(double from_m, double to_m, double step_m);

/// Extension beyond the planned walls of props that fill a tunnel from wall to wall, so that the
/// relief leaves no gap [m].
constexpr double kBehindWalls = 0.5;

/// The outline of a section of a tunnel, counter-clockwise: the right side forward, then the left
/// side backward; p_world [m].
std::vector<Eigen::Vector2d> section_outline(const TunnelLine& tunnel, double from_m, double to_m);

/// Position of a point along a section, 0 to 1; negative if it is not in the section.
double fraction_of_section(const TunnelLine& tunnel, double from_m, double to_m,
                           const Eigen::Vector2d& p_world);

}  // namespace adit

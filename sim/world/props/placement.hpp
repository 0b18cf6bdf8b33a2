// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include <Eigen/Core>

#include "sim/world/plan/tunnel_line.hpp"

namespace adit {

/// Which prop it is, as the world file has it: `props.posts[2]`.
inline std::string prop_name(const std::string& list, std::size_t index) {
  return "props." + list + "[" + std::to_string(index) + "]";
}

/// The drift in which a prop is. Throws std::invalid_argument, beginning with `what`, where there
/// is no such drift or `at_m` is not along it.
const TunnelLine& tunnel_with(const std::vector<TunnelLine>& tunnels, const std::string& name,
                              double at_m, const std::string& what);

/// The same for a stretch, which must not run backwards.
const TunnelLine& tunnel_with(const std::vector<TunnelLine>& tunnels, const std::string& name,
                              double from_m, double to_m, const std::string& what);

/// Places along a stretch, its ends included, at most `step_m` apart [m].
std::vector<double> places_between(double from_m, double to_m, double step_m);

/// How far what fills a drift from wall to wall goes on behind the planned walls, so that their
/// relief leaves no gap [m].
constexpr double kBehindWalls = 0.5;

/// The part of a drift from one place to another, as an outline: the right side onwards, then the
/// left side back; counter-clockwise, p_world [m].
std::vector<Eigen::Vector2d> stretch_outline(const TunnelLine& tunnel, double from_m, double to_m);

/// How far a place is along a stretch, from 0 to 1; negative for one that is not in it.
double share_of_stretch(const TunnelLine& tunnel, double from_m, double to_m,
                        const Eigen::Vector2d& p_world);

}  // namespace adit

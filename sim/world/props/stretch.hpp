// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include <Eigen/Core>

#include "sim/world/drift_line.hpp"

namespace adit {

/// How far what fills a drift from wall to wall goes on behind the planned walls, so that their
/// relief leaves no gap [m].
constexpr double kBehindWalls = 0.5;

/// The part of a drift from one place to another, as an outline: the right side onwards, then the
/// left side back; counter-clockwise, p_world [m].
std::vector<Eigen::Vector2d> stretch_outline(const DriftLine& drift, double from_m, double to_m);

/// How far a place is along a stretch, from 0 to 1; negative for one that is not in it.
double share_of_stretch(const DriftLine& drift, double from_m, double to_m,
                        const Eigen::Vector2d& p_world);

}  // namespace adit

// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include <Eigen/Core>

namespace adit {

// Where the ground is around a place of the plan, from points of which nobody said which are of
// the ground: the low ones of the cells near by, as far as these are below the laser. All
// in a frame with z up [m]. Both throw std::runtime_error where there is too little of it.

/// The median of the heights near by: half of them may be of something that stands there.
double estimate_ground_height(const std::vector<Eigen::Vector3d>& points,
                              const Eigen::Vector2d& p_plan, double laser_z_m);

/// Of the plane that most of the ground near by lies in, unit, upwards.
Eigen::Vector3d estimate_ground_normal(const std::vector<Eigen::Vector3d>& points,
                                       const Eigen::Vector2d& p_plan, double laser_z_m);

}  // namespace adit

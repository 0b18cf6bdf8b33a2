// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include <Eigen/Core>

#include "common/geometry/pose2.hpp"
#include "common/registration/degeneracy.hpp"
#include "common/sensing/scan_match.hpp"
#include "procs/scan_matching/motion_prediction.hpp"

namespace adit {

/// What stands in for the scan along `direction`, (x, y, θ) in the body frame with θ scaled by the
/// lever arm.
DegenerateDirection::Fill fill_of(const Eigen::Vector3d& direction, const MotionEstimate& expected);

/// What the bounds of motion alone say: information of (x, y, θ) in the body frame.
Eigen::Matrix3d reach_information(const MotionEstimate& expected);

/// Moves the pose towards the prediction along the directions that the match leaves open, all the
/// way where the match knows nothing.
Pose2 fill_open(const Pose2& T_odom_body, const MotionEstimate& expected,
                const std::vector<OpenDirection>& open, double lever_arm_m);

}  // namespace adit

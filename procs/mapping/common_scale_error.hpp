// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include <Eigen/Core>

#include "procs/mapping/displacement_error.hpp"

namespace adit {

/// What an error does elsewhere, by the linear effect of (x, y, θ) there on (x, y, θ) here.
WheelScaleError moved(const Eigen::Matrix3d& effect, WheelScaleError error);

/// The error of two successive displacements of a path as one, in the frame of the second.
/// `to_second`: the adjoint that moves an error of the first there.
WheelScaleError composed(const WheelScaleError& first, const WheelScaleError& second,
                         const Eigen::Matrix3d& to_second);

/// What to add to the covariance of a pose, of (x, y, θ), that takes the errors of displacements
/// for independent, where they share the scale of the wheels. `errors`: their effects on the pose,
/// in its frame.
///
/// What is known of the scale grows: its error has the variance s² at first and less later, and the
/// covariance of two of its errors is the lesser variance, as an estimate of a constant has its
/// error in common with each later one only as far as that is still wrong. Out and back along one
/// path the effects cancel, straight on they add up.
Eigen::Matrix3d common_scale_covariance(std::vector<WheelScaleError> errors);

}  // namespace adit

// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "common/geometry/pose2.hpp"

namespace adit {

/// Poses along a cubic Hermite curve from one pose to another, which the vehicle leaves and reaches
/// along its heading: forwards, or in reverse where the other pose is behind; after the first one,
/// up to `T_to`, about `spacing_m` apart. Empty if the curve is tighter than `radius_min_m`
/// anywhere, leads back somewhere, or has no length.
std::vector<Pose2> connecting_curve(const Pose2& T_from, const Pose2& T_to, double radius_min_m,
                                    double spacing_m);

}  // namespace adit

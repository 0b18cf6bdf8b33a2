// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "common/picture/rgb_image.hpp"
#include "common/types/cloud.hpp"

namespace adit {

/// The points of a 3D scan as one sees them who stands behind the vehicle and looks ahead (the
/// paper's figures 5a and 7): coloured by height above the ground, darker the farther away.
RgbImage cloud_image(const Cloud& cloud, int width, int height);

}  // namespace adit

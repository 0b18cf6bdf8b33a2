// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "common/picture/rgb_image.hpp"
#include "common/types/cloud.hpp"

namespace adit {

/// A perspective view of a 3D scan from behind the vehicle (the paper's figures 5a and 7): coloured
/// by height above the ground, darker with distance.
RgbImage cloud_image(const Cloud& cloud, int width, int height);

}  // namespace adit

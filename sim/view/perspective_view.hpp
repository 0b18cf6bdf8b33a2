// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "common/picture/rgb_image.hpp"
#include "sim/view/camera.hpp"
#include "sim/view/view_options.hpp"
#include "sim/world/world.hpp"

namespace adit {

/// The camera of the options. Where they name no place, it stands up to 2 m behind the start, as
/// far as the mine lets it, and looks the way of the start.
Camera camera_of(const Site& site, const ViewOptions& options, int width, int height);

/// What a person sees who stands there in the dark with a lamp beside the head. Where there is no
/// surface, it is day.
RgbImage perspective_view(const RayScene& scene, const Camera& camera);

}  // namespace adit

// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>

#include "common/picture/canvas.hpp"
#include "common/picture/map_layout.hpp"

namespace adit {

/// Where a path starts and ends, in pixels. The start is larger, so that it shows where the end
/// lies upon it.
void draw_start(const Canvas& canvas, const Eigen::Vector2d& p, double unit);
void draw_end(const Canvas& canvas, const Eigen::Vector2d& p, double unit);

/// The foot of the sheet: the scale in metres at the left, and at the right what the colours of the
/// path mean. Returns where these begin, left of which there is room for more [pixels].
void draw_scale_bar(const Canvas& canvas, const MapLayout& layout);
double draw_path_keys(const Canvas& canvas, const MapLayout& layout, bool with_degenerate);

}  // namespace adit

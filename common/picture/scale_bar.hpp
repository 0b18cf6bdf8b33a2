// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "common/picture/canvas.hpp"
#include "common/picture/scale_length.hpp"

namespace adit {

/// A bar of two halves, `metres` long, whose left end is at x and whose middle line at y, with its
/// length written below. `unit` is what a pixel of lettering is on this sheet.
void draw_scale_bar(const Canvas& canvas, double x, double y, double metres,
                    double pixels_per_metre, double unit);

}  // namespace adit

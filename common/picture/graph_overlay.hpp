// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "common/picture/canvas.hpp"
#include "common/picture/graph_picture.hpp"
#include "common/picture/map_layout.hpp"

namespace adit {

/// Draws a pose graph. Where its nodes are close together on the sheet, they are drawn smaller.
void draw_graph(const Canvas& canvas, const MapLayout& layout, const GraphPicture& graph);

/// The keys of those of its parts that there are, side by side at the foot of the sheet; `right` is
/// where they end [pixels].
void draw_graph_keys(const Canvas& canvas, const MapLayout& layout, const GraphPicture& graph,
                     double right);

}  // namespace adit

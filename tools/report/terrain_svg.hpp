// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include "common/grid/occupancy_grid.hpp"
#include "common/picture/rgb_image.hpp"
#include "common/vehicle/vehicle.hpp"
#include "tools/report/scan_pictures.hpp"

namespace adit {

/// The cells of a terrain that are worth a picture: where something is known, and where the path
/// leads.
CellBox box_to_show(const ScanToDraw& scan);

/// An image of the terrain's cells, cut to a box, with the vehicle and the path over it, or what is
/// in the way. `label` says what it is to who cannot see it.
std::string terrain_svg(const ScanToDraw& scan, const RgbImage& cells, const CellBox& box,
                        const Vehicle& vehicle, const std::string& label);

}  // namespace adit

// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include "common/grid/occupancy_grid.hpp"
#include "common/picture/rgb_image.hpp"
#include "common/types/planned_path.hpp"
#include "common/types/vehicle.hpp"
#include "tools/report/svg/scan_pictures.hpp"

namespace adit {

/// CSS class and name of a reason for a blocking cell.
struct BlockingName {
  const char* css_class;
  const char* name;
};
const BlockingName& blocking_name(BlockingCell::Reason reason);

/// Bounding box of the observed cells of a terrain with a margin, around the robot at least 6 m
/// wide.
CellBox visible_box(const ScanProducts& scan);

/// An SVG file of the cells of a terrain in a box: `cells` is the image of all cells, with goal,
/// path, blocking cells and vehicle on top. `title` is the text for screen readers.
std::string terrain_svg(const ScanProducts& scan, const RgbImage& cells, const CellBox& box,
                        const Vehicle& vehicle, const std::string& title);

}  // namespace adit

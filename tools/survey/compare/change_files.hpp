// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include <Eigen/Core>

#include "tools/survey/compare/change_regions.hpp"
#include "tools/survey/compare/surface_distances.hpp"
#include "tools/survey/files/geotiff_file.hpp"
#include "tools/survey/files/vector_layer.hpp"

namespace adit {

/// Distances in plan, for floor, roof and walls: six bands, the distance [m] and its level of
/// detection at 95 % for each; of the points over a cell that with the largest ratio of both.
/// `origin`: of comparison in the grid.
Raster change_raster(const std::vector<SurfaceDistance>& distances, const Eigen::Vector3d& origin,
                     double cell_m);

/// The regions as points (`changes`), and their outlines in plan (`change_outlines`), in the grid.
std::vector<VectorLayer> change_layers(const std::vector<ChangeRegion>& regions,
                                       const std::vector<SurfaceDistance>& distances,
                                       const Eigen::Vector3d& origin, double cell_m);

/// The regions as comma-separated values.
std::string change_table(const std::vector<ChangeRegion>& regions, const Eigen::Vector3d& origin);

}  // namespace adit

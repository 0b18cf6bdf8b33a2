// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include <Eigen/Core>

#include "tools/survey/compare/change_regions.hpp"
#include "tools/survey/compare/surface_distances.hpp"

namespace adit {

/// Draws a map of significant change as PDF on A3: what both surveys show in grey, the regions red
/// where rock is gone and blue where a surface moved into the void, numbered as in the table beside
/// it, and the statements. Throws FileError.
void write_change_sheet(const std::vector<SurfaceDistance>& distances,
                        const std::vector<ChangeRegion>& regions, const Eigen::Vector3d& origin,
                        const std::vector<std::string>& statements,
                        const std::filesystem::path& path);

}  // namespace adit

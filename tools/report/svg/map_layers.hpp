// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "common/types/exploration.hpp"
#include "tools/report/svg/map_svg.hpp"
#include "tools/report/svg/map_view.hpp"

namespace adit {

// Layers of the map of a mission, one <g> each; empty without content. `page` is the file that
// links refer to; empty for the page that contains the map.

std::string corridors_svg(const CorridorGraph& graph, const MapView& view);
std::string graph_svg(const MissionMap& map, const MapView& view);
/// Outbound and return path. They mostly overlap, therefore the return path is thin and dashed.
std::string paths_svg(const Trajectory& path, const std::optional<std::int64_t>& return_home_utime,
                      const MapView& view);
std::string frontiers_svg(const std::vector<Frontier>& frontiers, const MapView& view,
                          const std::string& page);
/// Numbers to the left of the scan direction, so that those of the return path are on the other
/// side of the tunnel.
std::string scans_svg(const std::vector<ScanMark>& scans, const MapView& view,
                      const std::string& page);
/// First and last position.
std::string ends_svg(const Trajectory& path, const MapView& view);

}  // namespace adit

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

// Layers of the map of a mission, a <g> each; empty where there is nothing to show. `page` is where
// links lead; empty for the page that the map is on.

std::string corridors_svg(const CorridorGraph& graph, const MapView& view);
std::string graph_svg(const MissionMap& map, const MapView& view);
/// Out and home, told apart by colour and dashes: they mostly lie upon each other.
std::string paths_svg(const Trajectory& path, const std::optional<std::int64_t>& homeward_utime,
                      const MapView& view);
std::string frontiers_svg(const std::vector<Frontier>& frontiers, const MapView& view,
                          const std::string& page);
/// Numbers to the left of the way on, so that those of the way home are on the other side.
std::string scans_svg(const std::vector<ScanMark>& scans, const MapView& view,
                      const std::string& page);
std::string start_svg(const Trajectory& path, const MapView& view);

/// "open", "explored", ...: what became of an opening.
const char* name_of(FrontierState state);

}  // namespace adit

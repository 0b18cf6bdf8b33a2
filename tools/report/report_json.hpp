// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include "common/types/exploration.hpp"
#include "tools/report/mission_statistics.hpp"

namespace adit {

/// Figures of a mission as JSON, for summary.json. Values without data in the log are null.
std::string mission_summary_json(const MissionStatistics& statistics, const LogInfo& log_info);

/// The corridor graph as GeoJSON: corridors as lines; junctions, dead ends and frontiers as points,
/// frontiers with state and evidence. Coordinates are x and y in the map frame in metres, not
/// longitude and latitude; the foreign member `coordinates_are` says so.
std::string junctions_geojson(const ExplorationReport& report);

}  // namespace adit

// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include "common/types/exploration.hpp"
#include "tools/report/mission_statistics.hpp"

namespace adit {

/// The figures of a mission as JSON, for summary.json. What the log does not tell is null.
std::string mission_summary_json(const MissionStatistics& statistics, const LogInfo& log_info);

/// The corridor graph as GeoJSON: corridors as lines; junctions, dead ends and openings as points,
/// the openings with their state and its evidence. Coordinates are metres in the plan of the map
/// frame, x and y, and no longitude and latitude: a foreign member says so.
std::string junctions_geojson(const ExplorationReport& report);

}  // namespace adit

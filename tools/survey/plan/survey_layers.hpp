// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "tools/survey/files/vector_layer.hpp"
#include "tools/survey/mine_survey.hpp"

namespace adit {

/// What a survey shows in plan, for GIS and CAD, in the grid: walls and pillars (outlines of the
/// void), centre_lines (tunnels with their measures, elevations of the floor), sections (stations
/// along them), junctions, frontiers, hazards, floor_contours, path, scans, traverse (the local
/// maps with their standard deviations and 95 % ellipses), control and water. Layers without
/// features are left out.
std::vector<VectorLayer> survey_layers(const MineSurvey& survey);

}  // namespace adit

// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "common/records/hazard.hpp"
#include "tools/survey/frame/survey_graph.hpp"

namespace adit {

/// A hazard in the frame of the survey.
struct HazardMark {
  Hazard hazard;  ///< its first observation, grown by those joined with it
  LevelPose T_survey_centre;
};

/// Places observations by the local maps of their times, and joins those of one hazard. At most
/// kHazardsMax.
std::vector<HazardMark> hazard_marks(const std::vector<Hazard>& observed, const SurveyGraph& graph);

}  // namespace adit

// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "tools/survey/plan/hazard_marks.hpp"

namespace adit {
namespace {

/// Joins an observation with a hazard that it touches; false if there is none.
bool join_any(const Hazard& observed, const LevelPose& T_survey_observed,
              std::vector<HazardMark>& marks) {
  for (HazardMark& mark : marks) {
    const auto shift =
        join(mark.hazard, observed, between(mark.T_survey_centre, T_survey_observed));
    if (!shift) continue;
    mark.T_survey_centre = mark.T_survey_centre * *shift;
    return true;
  }
  return false;
}

}  // namespace

std::vector<HazardMark> hazard_marks(const std::vector<Hazard>& observed,
                                     const SurveyGraph& graph) {
  std::vector<HazardMark> marks;
  for (const Hazard& hazard : observed) {
    const SurveyGraph::Node& node = graph.nodes()[graph.node_at(hazard.utime)];
    const LevelPose T_survey_centre =
        node.T_survey_local * between(node.T_odom_local, hazard.T_odom_centre);
    if (join_any(hazard, T_survey_centre, marks) || marks.size() >= kHazardsMax) continue;
    marks.push_back({hazard, T_survey_centre});
  }
  return marks;
}

}  // namespace adit

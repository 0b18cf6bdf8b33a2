// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "tools/survey/mine_survey.hpp"
#include "tools/survey/section/clearance.hpp"
#include "tools/survey/sheet/plan_sheet.hpp"
#include "tools/survey/survey.hpp"
#include "tools/survey/traverse/traverse_report.hpp"

namespace adit {

/// That a control point may be a blunder, a sentence.
std::string suspicion(const ControlResidual& point);
/// That a laser is not mounted as configured, a sentence; empty if nothing shows it.
std::string suspicion(const std::optional<LaserAlignment>& alignment);
/// How well the lasers agree, a sentence; empty if that is not known.
std::string alignment_statement(const std::optional<LaserAlignment>& alignment);

/// That the workings may meet a given line, a sentence.
std::string encounter(const CloseApproach& approach);

/// What the plan sheet says beside the plan.
PlanSheetText sheet_text(const MineSurvey& survey, const SurveyResult& result);

/// A person, a cart and the robot of the mission.
std::vector<Envelope> envelopes_of(const MineSurvey& survey);

/// What the report says of a survey.
TraverseReport report_of(const MineSurvey& survey, const SurveyResult& result);

}  // namespace adit

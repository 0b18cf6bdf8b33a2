// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "tools/survey/files/vector_layer.hpp"
#include "tools/survey/sheet/plan_sheet.hpp"
#include "tools/survey/traverse/traverse.hpp"

namespace adit {

/// A section whose envelope does not fit, or barely does, for the report.
struct NarrowPlace {
  std::string place;  ///< tunnel and chainage
  std::string envelope;
  double above_m = 0.0;
  double beside_m = 0.0;
};

/// What the report shows.
struct TraverseReport {
  PlanSheetText text;
  std::vector<BudgetRow> budget;
  std::vector<TraverseLoop> loops;
  std::vector<NarrowPlace> narrow;     ///< the narrowest first
  std::vector<std::string> envelopes;  ///< what was looked for, with its sizes
};

/// Writes a PDF of at most four pages A4: statements and the accuracy budget; the traverse in plan
/// with its 95 % ellipses, drawn larger by a factor that it states; its stations, thinned to a
/// page; the loops with the largest misclosures, and where an envelope does not fit. `layers`: of
/// the survey, for the walls. Throws FileError.
void write_traverse_report(const TraverseReport& report, const std::vector<VectorLayer>& layers,
                           const SurveyGraph& graph, const SurveyFrame& frame,
                           const std::filesystem::path& path);

}  // namespace adit

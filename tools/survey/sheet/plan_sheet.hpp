// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "tools/survey/files/vector_layer.hpp"

namespace adit {

/// Size of a sheet, landscape.
struct Paper {
  double width_mm = 420.0;
  double height_mm = 297.0;
};

inline constexpr Paper kPaperA3{420.0, 297.0};
inline constexpr Paper kPaperA1{841.0, 594.0};

/// What a plan sheet says beside the plan.
struct PlanSheetText {
  std::string title;
  std::string date;                     ///< of the end of the mission
  std::string identity;                 ///< of the files from which it is made
  bool grid_north = false;              ///< whether the y axis of the grid is its north
  std::vector<std::string> statements;  ///< coordinate system, accuracy; a paragraph each
};

/// Draws the layers of a survey (survey_layers) to scale as PDF: the largest usual scale at
/// which they fit, a grid with its coordinates, an arrow for the y axis, scale bar, legend and
/// statements. Throws FileError.
void write_plan_sheet(const std::vector<VectorLayer>& layers, const PlanSheetText& text,
                      const Paper& paper, const std::filesystem::path& path);

}  // namespace adit

// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "tools/survey/frame/laser_alignment.hpp"
#include "tools/survey/mesh/void_mesh.hpp"
#include "tools/survey/mine_survey.hpp"

namespace adit {

/// What was surveyed, for a person.
struct SurveyResult {
  std::string frame;  ///< the coordinate system, a sentence
  std::size_t scans = 0;
  std::size_t points = 0;
  double length_m = 0.0;  ///< of the centre lines
  std::size_t sections = 0;
  VoidVolume void_space;
  MeshCheck mesh;
  double plan_sd_max_m =
      0.0;  ///< largest standard deviation of a local map, in the worst direction
  double z_sd_max_m = 0.0;
  std::vector<ControlResidual> control;  ///< empty without control
  /// Nothing with one laser, and where too few scans of both see the same.
  std::optional<LaserAlignment> alignment;
  std::vector<std::string> warnings;  ///< one sentence each
};

/// Surveys the mine of a mission and writes the files that `adit survey --help` lists. Throws
/// std::invalid_argument for options out of bounds, and std::runtime_error if a log cannot be read,
/// or has no map or no 3D scan, or if a file cannot be written; the folder is unchanged then.
SurveyResult write_survey(const SurveyOptions& options, const SurveyProgress& progress = {});

}  // namespace adit

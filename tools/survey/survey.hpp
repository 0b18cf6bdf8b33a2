// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "tools/survey/raster/void_volume.hpp"

namespace adit {

struct SurveyOptions {
  std::vector<std::filesystem::path> mission;  ///< folder of a mission, or its logs
  std::filesystem::path folder;                ///< created if it does not exist
  double every_m = 5.0;                        ///< between cross-sections
  double cell_m = 0.1;                         ///< of rasters
};

/// What was surveyed, for a person.
struct SurveyResult {
  std::string frame;  ///< the coordinate system, a sentence
  std::size_t scans = 0;
  std::size_t points = 0;
  double length_m = 0.0;  ///< of the centre lines
  std::size_t sections = 0;
  VoidVolume void_space;
  double plan_sd_max_m =
      0.0;  ///< largest standard deviation of a local map, in the worst direction
  double z_sd_max_m = 0.0;
  std::vector<std::string> warnings;  ///< one sentence each
};

/// Names the present step and how much of it is done, 0 to 1.
using SurveyProgress = std::function<void(const std::string& step, double done)>;

/// Surveys the mine of a mission and writes the files that `adit survey --help` lists. Throws
/// std::invalid_argument for options out of bounds, and std::runtime_error if a log cannot be read,
/// or has no map or no 3D scan, or if a file cannot be written; the folder is unchanged then.
SurveyResult write_survey(const SurveyOptions& options, const SurveyProgress& progress = {});

}  // namespace adit

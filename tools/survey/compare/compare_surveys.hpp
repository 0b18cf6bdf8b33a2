// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "tools/survey/compare/change_regions.hpp"
#include "tools/survey/compare/scan_placement.hpp"
#include "tools/survey/compare/surface_distances.hpp"

namespace adit {

struct CompareOptions {
  std::filesystem::path older;   ///< folder of `adit survey`
  std::filesystem::path newer;   ///< the same of a later mission
  std::filesystem::path folder;  ///< created if it does not exist
  /// Whether scans are compared where their coordinates place them, instead of being registered.
  bool by_coordinates = false;
};

/// What changed, for a person.
struct CompareResult {
  std::vector<SurfaceDistance> distances;
  std::vector<ChangeRegion> regions;      ///< largest volume first
  Eigen::Vector3d origin{0.0, 0.0, 0.0};  ///< of comparison, in the grid
  double area_m2 = 0.0;                   ///< that both surveys show
  double significant_m2 = 0.0;            ///< of it, with a distance above the level of detection
  double unmeasured_m2 = 0.0;           ///< of the older survey, not seen within reach by the newer
  double detection_median_m = 0.0;      ///< level of detection, 95 %
  std::size_t scans = 0;                ///< of the newer survey
  std::size_t registered = 0;           ///< of these
  std::vector<std::string> statements;  ///< how it was compared, a sentence each
  std::vector<std::string> warnings;
};

/// Names the present step and how much of it is done, 0 to 1.
using CompareProgress = std::function<void(const std::string& step, double done)>;

/// Compares two surveys and writes the files that `adit survey compare --help` lists. Throws
/// std::runtime_error if a survey cannot be read, if both are in different coordinate systems, or
/// if they show no common surface; and if a file cannot be written. The folder is unchanged then.
CompareResult compare_surveys(const CompareOptions& options, const CompareProgress& progress = {});

}  // namespace adit

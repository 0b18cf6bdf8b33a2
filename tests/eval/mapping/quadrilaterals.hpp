// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "procs/mapping/loop_closure/map_matching.hpp"
#include "tests/eval/mapping/loop_closure_runs.hpp"

namespace adit {

/// By how much the ways around quadrilaterals fail to close, one value for each.
struct QuadrilateralGaps {
  std::vector<double> metres;
  std::vector<double> degrees;
  std::vector<double> normalised;  ///< squared, by the stated information; expectation 3
};

/// Two maps and the next ones after them make a quadrilateral: two matches across, and the
/// displacements along the sides. Around it all must add up to nothing, which needs no truth. Each
/// map is matched with one other alone, so that the two matches have no scan in common.
QuadrilateralGaps close_quadrilaterals(const MappedRun& run, const MapMatchingParams& params);

}  // namespace adit

// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "procs/mapping/loop_closure/map_matching.hpp"
#include "tests/eval/mapping/loop_closure_runs.hpp"

namespace adit {

/// Closing errors of quadrilaterals of local maps, one value for each.
struct QuadrilateralGaps {
  std::vector<double> metres;
  std::vector<double> degrees;
  std::vector<double> normalised;  ///< squared, by the estimated covariance; expectation 3
};

/// Computes closing errors, which need no ground truth. Two local maps and a neighbour of each form
/// a quadrilateral of two matches and two displacements, whose product should be the identity. Each
/// map is matched with one other map only, so that the two matches share no scans.
QuadrilateralGaps close_quadrilaterals(const MappedRun& run, const MapMatchingParams& params);

}  // namespace adit

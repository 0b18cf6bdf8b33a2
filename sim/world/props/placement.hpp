// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include "sim/world/drift_line.hpp"

namespace adit {

/// The drift in which a prop is. Throws std::invalid_argument, beginning with `what`, where there
/// is no such drift or `at_m` is not along it.
const DriftLine& drift_with(const std::vector<DriftLine>& drifts, const std::string& name,
                            double at_m, const std::string& what);

/// The same for a stretch, which must not run backwards.
const DriftLine& drift_with(const std::vector<DriftLine>& drifts, const std::string& name,
                            double from_m, double to_m, const std::string& what);

/// Places along a stretch, its ends included, at most `step_m` apart [m].
std::vector<double> places_between(double from_m, double to_m, double step_m);

}  // namespace adit

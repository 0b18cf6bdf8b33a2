// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

namespace adit {

/// The value below which a share of the values lies, 0 to 1: one of the values, 0 if there are
/// none.
double quantile(std::vector<double> values, double share);

/// The middle value, the upper one of two: 0 if there are none.
double median(std::vector<double> values);

}  // namespace adit

// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "tools/campaign/definition/campaign_definition.hpp"
#include "tools/database/database.hpp"

namespace adit {

/// The distribution of a value over the units that have a result.
struct Histogram {
  std::string name;
  std::vector<int> counts;  ///< of bins of equal width; a single one if all values are equal
  double min = 0.0;         ///< left edge of the first bin, the smallest value
  double max = 0.0;         ///< right edge of the last, the largest
  double median = 0.0;
  double percentile95 = 0.0;
  std::size_t values = 0;
  std::size_t without = 0;  ///< units without a number
};

Histogram measure_histogram(const DistributionDefinition& definition, Database& database);

}  // namespace adit

// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include "tools/campaign/definition/campaign_definition.hpp"
#include "tools/campaign/results/proportions.hpp"
#include "tools/database/database.hpp"

namespace adit {

/// Units for which a condition is true, false, or has no value since the unit failed or a score is
/// null.
struct RateCounts {
  int yes = 0;
  int no = 0;
  int unknown = 0;

  [[nodiscard]] int total() const { return yes + no + unknown; }
};

enum class RateVerdict {
  kNotAsked,   ///< no bounds
  kShown,      ///< the interval is within the bounds
  kMet,        ///< the share is within them, the interval is not
  kNotMet,     ///< the share is outside
  kNotCounted  ///< no unit counts
};

/// A share of the units with what was asked for. A unit without a value counts against the bounds:
/// as yes if only `max` is a bound, as no otherwise.
struct Rate {
  RateDefinition definition;
  RateCounts counts;

  [[nodiscard]] bool unknown_counts_as_yes() const;
  [[nodiscard]] int count() const;
  [[nodiscard]] double share() const;
  [[nodiscard]] ShareInterval interval() const;
  [[nodiscard]] RateVerdict verdict() const;
};

/// All rates over the units that have a result, in a view like `campaign`.
std::vector<Rate> measure_rates(const CampaignDefinition& definition, Database& database,
                                const std::string& view = "campaign");

/// SQL expression that is true for a unit that counts against the bounds of the rate, false
/// otherwise; empty for a rate without bounds.
std::string violation_of(const RateDefinition& rate);

}  // namespace adit

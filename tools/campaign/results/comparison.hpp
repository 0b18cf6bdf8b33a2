// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "tools/campaign/results/rates.hpp"
#include "tools/campaign/results/result_table.hpp"

namespace adit {

/// A unit for which a condition has another value than in an earlier campaign.
struct ChangedUnit {
  int number = 0;
  std::string id;
  std::string parameters;  ///< as JSON
  bool is_now = false;     ///< whether the condition is true now
};

/// One rate now and in an earlier campaign. Pairs are units of the same parameters; one without a
/// value counts as in Rate.
struct RateComparison {
  Rate now;
  Rate earlier;
  int pairs = 0;
  int only_now = 0;
  int only_earlier = 0;
  double mcnemar_p = 1.0;  ///< of the pairs
  double fisher_p = 1.0;   ///< of all units, as if they were independent
  std::vector<ChangedUnit> changed;
};

/// Throws FileError if the folder has no results of a campaign.
void require_campaign(const std::filesystem::path& folder);

/// Evaluates the rates of this campaign on the results of an earlier one, which may have other
/// scores: those it lacks are null. Throws FileError if the folder has no campaign.
std::vector<RateComparison> compare_campaigns(ResultTable& table,
                                              const CampaignDefinition& definition,
                                              const std::filesystem::path& earlier);

}  // namespace adit

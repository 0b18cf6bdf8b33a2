// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "tools/campaign/definition/campaign_definition.hpp"
#include "tools/campaign/results/comparison.hpp"
#include "tools/campaign/results/histogram.hpp"
#include "tools/campaign/results/rates.hpp"
#include "tools/campaign/results/worst_units.hpp"
#include "tools/campaign/run/campaign_folder.hpp"

namespace adit {

/// What campaign.html shows.
struct CampaignPage {
  std::string name;
  int units = 0;
  int with_result = 0;
  std::optional<int> stopped_after = {};
  double wall_s = 0.0;                              ///< of all units together
  std::vector<std::pair<std::string, int>> states;  ///< how many units ended how
  std::vector<Rate> rates;
  std::vector<Histogram> histograms;
  std::vector<WorstUnit> worst;
  std::string worst_by;  ///< CampaignDefinition::worst
  std::string report;    ///< CampaignDefinition::report
  std::string compared_with;
  std::vector<RateComparison> comparisons;
  std::string file_text;  ///< the campaign file
};

/// Reads it from the results; comparisons are left empty.
CampaignPage describe_campaign(const CampaignDefinition& definition, Database& database);

/// A self-contained page in HTML. Links are relative to the folder.
std::string campaign_html(const CampaignPage& page, const CampaignFolder& folder);

}  // namespace adit

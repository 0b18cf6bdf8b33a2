// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include "tools/campaign/definition/campaign_definition.hpp"
#include "tools/database/database.hpp"

namespace adit {

struct WorstUnit {
  int number = 0;
  std::string id;
  std::string parameters;  ///< as JSON
  std::string state;
  std::string reason;
  std::string scores;    ///< as JSON, {} if it has none
  std::string command;   ///< a line for a shell that repeats it
  std::string value;     ///< of CampaignDefinition::worst; empty without one
  int violations = 0;    ///< rates against whose bounds it counts
  std::string violated;  ///< their names, with commas
};

/// The `count` worst units: first those against the bounds of most rates, of these those that did
/// not end, then those with the largest value of CampaignDefinition::worst.
std::vector<WorstUnit> worst_units(const CampaignDefinition& definition, Database& database,
                                   int count);

}  // namespace adit

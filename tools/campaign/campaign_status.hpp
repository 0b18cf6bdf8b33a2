// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "tools/campaign/results/rates.hpp"

namespace adit {

/// How far a campaign is, also while it runs.
struct CampaignStatus {
  std::string name;
  int units = 0;
  int with_result = 0;
  bool is_running = false;                          ///< whether an `adit campaign` holds the folder
  std::vector<std::pair<std::string, int>> states;  ///< how many units ended how
  std::vector<Rate> rates;
  /// At the pace since it was started last; nothing before the first result.
  std::optional<double> time_to_go_s;
};

/// Reads the results in the folder; changes nothing. Throws FileError if there are none.
CampaignStatus read_campaign_status(const std::filesystem::path& folder);

}  // namespace adit

// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "tools/campaign/definition/campaign_definition.hpp"

namespace adit {

struct UnitScores {
  std::string json;     ///< {"outcome":"home","rmse_m":0.04}; null for a value that is not there
  std::string failure;  ///< a file that cannot be read; empty if all can be
};

/// Reads what a unit is scored by from its outputs. `parameters` (JSON) fills placeholders in names
/// of files. A value in a readable file that is not there, or is neither number, text nor truth, is
/// null.
UnitScores read_scores(const std::vector<ScoreDefinition>& definitions,
                       const std::filesystem::path& output, const std::string& parameters);

}  // namespace adit

// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "tools/campaign/definition/campaign_plan.hpp"
#include "tools/campaign/results/rates.hpp"

namespace adit {

struct CampaignOptions {
  std::filesystem::path file;
  std::filesystem::path folder;
  std::optional<std::filesystem::path> compare = {};  ///< folder of an earlier campaign
  bool on_slurm = false;
  int jobs = 0;                         ///< units at the same time; 0: as many as cores allow
  int stop_descriptor = -1;             ///< ends the run when it is readable; see StopSignal
  std::filesystem::path programs = {};  ///< folder of adit and adit-watch; empty: of this program
};

struct CampaignProgress {
  int run = 0;     ///< units that ended since this run of the campaign began
  int to_run = 0;  ///< units without a result when it began
  int failed = 0;  ///< units of this run that did not end
};

struct CampaignResult {
  int units = 0;        ///< of the plan, or the first that suffice
  int with_result = 0;  ///< of these
  bool interrupted = false;
  std::optional<int> stopped_after = {};  ///< units that suffice for the rates
  std::vector<Rate> rates;

  [[nodiscard]] bool is_complete() const { return with_result == units; }
  /// Whether it is complete and all rates are within their bounds.
  [[nodiscard]] bool succeeded() const;
};

/// Runs what is missing of a campaign, and writes its page. `notify` is told what the user should
/// know. Throws ConfigError, FileError or std::runtime_error.
CampaignResult run_campaign(const CampaignOptions& options,
                            const std::function<void(const CampaignProgress&)>& progress,
                            const std::function<void(const std::string&)>& notify);

/// Runs one unit of the plan in the folder, as a task of Slurm does; nothing to do if it has a
/// result. Returns false if it was stopped by the descriptor. `programs`: folder of adit-watch.
/// Throws FileError.
bool run_campaign_unit(const std::filesystem::path& folder, const std::string& id,
                       int stop_descriptor,
                       const std::filesystem::path& programs = own_program_folder());

}  // namespace adit

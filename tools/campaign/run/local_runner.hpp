// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <functional>
#include <vector>

#include "tools/campaign/definition/campaign_plan.hpp"
#include "tools/campaign/run/campaign_folder.hpp"
#include "tools/campaign/run/unit_result.hpp"

namespace adit {

/// Runs units on this computer.
struct LocalRunner {
  int jobs = 1;  ///< units at the same time
  std::filesystem::path watcher = own_program_folder() / "adit-watch";
  int stop_descriptor = -1;  ///< ends the run when it is readable; see StopSignal

  /// Units at the same time that this computer has cores for.
  static int jobs_for(int cores_of_unit);

  /// Is told each result, as units end. Returns whether to continue; if not, units that run are
  /// killed and have no result.
  using OnResult = std::function<bool(const CampaignUnit&, const UnitResult&)>;

  /// Starts the units in their order. Returns false if it was stopped by the descriptor. Units that
  /// ran then have no result. Throws as UnitProcess does.
  bool run(const CampaignPlan& plan, const std::vector<const CampaignUnit*>& units,
           const CampaignFolder& folder, const OnResult& on_result) const;
};

}  // namespace adit

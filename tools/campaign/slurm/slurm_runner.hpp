// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "tools/campaign/definition/campaign_plan.hpp"
#include "tools/campaign/run/campaign_folder.hpp"
#include "tools/campaign/run/local_runner.hpp"

namespace adit {

/// Runs units on a Slurm cluster: job arrays, one task per unit, each of which is
/// `adit campaign run-unit`. The folder must be on a file system that all nodes share. A task
/// writes its result to the folder of its unit, where this finds it, so that neither a restart of
/// the controller nor the end of this process loses one. Limits are those of the unit process;
/// Slurm has slightly larger ones, for a unit process that fails.
struct SlurmRunner {
  std::filesystem::path programs = own_program_folder();  ///< has adit and adit-watch, on all nodes
  int cores = 1;                                          ///< of a unit
  int jobs = 0;  ///< units at the same time in each array; 0: as many as the cluster runs
  double queue_period_s = 3.0;  ///< between queries of the queue
  int stop_descriptor = -1;     ///< ends the run when it is readable; tasks continue
  std::function<void(const std::string&)> notify = [](const std::string&) {};

  /// As LocalRunner: submits those units that no task in the queue works on, also after an earlier
  /// run, and returns when all have a result. A unit whose tasks ended without one is submitted
  /// again, and is `lost` after three times. If `on_result` returns false the rest is cancelled.
  bool run(const CampaignPlan& plan, const std::vector<const CampaignUnit*>& units,
           const CampaignFolder& folder, const LocalRunner::OnResult& on_result) const;
};

}  // namespace adit

// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <string>
#include <utility>
#include <vector>

#include "tools/campaign/definition/campaign_definition.hpp"
#include "tools/campaign/definition/parameter_matrix.hpp"

namespace adit {

/// One run of the command of a campaign.
struct CampaignUnit {
  int number = 0;  ///< from 1, in the order in which units start
  /// 16 hexadecimal digits of the SHA-256 of the command, the content of its inputs and its
  /// program: units of the same id have the same result.
  std::string id;
  std::string parameters;  ///< as JSON
  std::vector<std::pair<std::string, std::string>> environment;
  std::vector<std::string> arguments;  ///< the program first; {out} is left to whoever runs it
};

/// What is run: the units and what is the same for all of them.
struct CampaignPlan {
  std::filesystem::path folder;  ///< working folder of all units: that of the campaign file
  double time_max_s = 0.0;
  double memory_max_mb = 0.0;
  std::vector<int> exit_codes;
  std::vector<std::string> remove;
  std::vector<CampaignUnit> units;
};

/// Where programs without a slash in their name are searched, before PATH: the folder of this
/// program, so that `adit` in a campaign is the one that runs it.
std::filesystem::path own_program_folder();

/// Expands the command for all parameters, and hashes inputs and programs. If a rate may stop the
/// campaign the units are in an order that depends on their parameters alone and is otherwise
/// random, so that the first n are a sample of all. `file` names the campaign in errors. Throws
/// ConfigError, also for a program or an input that does not exist.
CampaignPlan make_plan(const CampaignDefinition& campaign,
                       const std::vector<UnitParameters>& parameters, const std::string& file,
                       const std::filesystem::path& folder,
                       const std::filesystem::path& programs = own_program_folder());

/// The arguments of a unit with {out} replaced.
std::vector<std::string> with_output(const std::vector<std::string>& arguments,
                                     const std::string& out);

/// The word in quotes for a shell, if it needs them.
std::string shell_word(const std::string& word);

/// The unit as a line for a shell in any folder; its output goes to `out`.
std::string shell_line(const CampaignPlan& plan, const CampaignUnit& unit, const std::string& out);

/// Lines of JSON, for `adit campaign run-unit`. Throws FileError.
void write_plan(const CampaignPlan& plan, const std::filesystem::path& path);
/// Reads the plan with the unit of this id alone. Throws FileError if it is not in the plan.
CampaignPlan read_plan(const std::filesystem::path& path, const std::string& id);

}  // namespace adit

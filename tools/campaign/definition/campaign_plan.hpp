// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "common/process_list/command_line.hpp"
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
  /// Path below {out} and content of the files that are written before it starts.
  std::vector<std::pair<std::string, std::string>> files;
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

/// Expands the command of a campaign for the parameters of one unit after another. Hashes inputs
/// and programs once: a search has all its units of the same program.
class UnitMaker {
 public:
  /// `file` names the campaign in errors. Throws ConfigError.
  UnitMaker(const CampaignDefinition& campaign, std::string file, std::filesystem::path folder,
            std::filesystem::path programs);

  /// A unit without a number. Throws ConfigError, also for a program or an input that does not
  /// exist.
  CampaignUnit unit(const UnitParameters& parameters);

 private:
  [[noreturn]] void fail(const std::string& key, const std::string& reason) const;
  [[nodiscard]] CommandLine words(const std::string& text, const std::string& key) const;
  [[nodiscard]] std::string expanded(const std::string& text, const UnitParameters& parameters,
                                     const std::string& key) const;
  std::filesystem::path find_program(const std::string& name);
  [[nodiscard]] std::filesystem::path search_program(const std::string& name) const;
  const std::string& hash_of(const std::filesystem::path& path, const std::string& key);
  std::string id(const CampaignUnit& unit, const std::filesystem::path& program,
                 const UnitParameters& parameters);

  std::string file_;
  std::filesystem::path folder_;
  std::filesystem::path programs_;
  CommandLine command_;
  std::vector<UnitFileDefinition> files_;
  std::vector<std::string> inputs_;
  std::map<std::string, std::filesystem::path> programs_found_;
  std::map<std::string, std::string> hashes_;
};

/// The plan without its units. `file` names the campaign in errors. Throws ConfigError.
CampaignPlan plan_without_units(const CampaignDefinition& campaign, const std::string& file,
                                const std::filesystem::path& folder);

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

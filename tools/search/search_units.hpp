// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <filesystem>
#include <functional>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "common/files/locked_file.hpp"
#include "tools/campaign/definition/campaign_definition.hpp"
#include "tools/campaign/definition/campaign_plan.hpp"
#include "tools/campaign/results/result_table.hpp"
#include "tools/campaign/run/campaign_folder.hpp"
#include "tools/campaign/run/local_runner.hpp"
#include "tools/search/cross_entropy.hpp"
#include "tools/search/search_definition.hpp"
#include "tools/search/search_space.hpp"

namespace adit {

/// The file of a search.
struct SearchFile {
  std::string name;
  std::string text;
  std::filesystem::path folder;  ///< absolute, in which units run
  CampaignDefinition campaign;
  SearchDefinition search;
  SearchSpace space;
};

/// Throws ConfigError or FileError.
SearchFile load_search_file(const std::filesystem::path& path);

/// A unit that has a result.
struct SearchUnit {
  const CampaignUnit* unit = nullptr;
  SearchPoint point;
  Evaluation evaluation;
  double cpu_s = 0.0;
};

/// Runs points of the space as units of a campaign whose plan grows; those with a result in the
/// folder do not run again.
class SearchUnits {
 public:
  /// Opens or creates the folder, which is locked as that of a campaign. Throws ConfigError, also
  /// for an expression of the file that SQLite does not understand, and FileError.
  SearchUnits(const SearchFile& file, const CampaignFolder& folder,
              const std::filesystem::path& programs);

  /// Adds the points to the plan, and takes results that are in the folder. Returns the index in
  /// the plan of each.
  std::vector<std::size_t> add(const std::vector<SearchPoint>& points);

  /// Is told each unit that has run. Returns whether to continue.
  using OnUnit = std::function<bool(const SearchUnit&)>;

  /// Runs the units of the plan that have no result. Returns whether all have one now: false if the
  /// runner or `on_unit` stopped it. Throws as LocalRunner does, and std::runtime_error if the
  /// command cannot be started.
  bool run(const LocalRunner& runner, const OnUnit& on_unit);

  /// All units that have a result, in the order of the plan.
  [[nodiscard]] std::vector<SearchUnit> with_result();
  [[nodiscard]] const CampaignPlan& plan() const { return plan_; }

 private:
  std::size_t add_point(const SearchPoint& point);
  /// Units with a result whose columns satisfy the condition, in order.
  std::vector<SearchUnit> read(const std::string& condition);

  const SearchFile& file_;
  CampaignFolder folder_;
  LockedFile lock_;
  UnitMaker maker_;
  CampaignPlan plan_;
  std::vector<SearchPoint> points_;         ///< of the units of the plan
  std::map<std::string, std::size_t> ids_;  ///< index in the plan
  ResultTable table_;
};

/// The text without its numbers: "3 of 12.5 m" becomes "# of # m", so that the reasons of two
/// failures of one kind are equal.
std::string without_numbers(const std::string& text);

}  // namespace adit

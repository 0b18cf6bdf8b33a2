// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "tools/campaign/definition/campaign_definition.hpp"
#include "tools/campaign/definition/campaign_plan.hpp"
#include "tools/campaign/run/campaign_folder.hpp"
#include "tools/campaign/run/unit_result.hpp"
#include "tools/database/database.hpp"

namespace adit {

/// The results of a campaign in SQLite. The table `units` has the units of the plan, `results` how
/// they ended, by id, also those of earlier plans. The view `campaign` joins them: one row for each
/// unit that counts, with a column for each parameter and score; its columns state to host are null
/// for a unit without a result.
class ResultTable {
 public:
  /// Opens or creates the table, and replaces the plan. `file_text`: content of the campaign file
  /// `file`. Throws FileError, and ConfigError for an
  /// expression of the definition that SQLite does not understand.
  ResultTable(const CampaignFolder& folder, const CampaignDefinition& definition,
              const CampaignPlan& plan, const std::string& file, const std::string& file_text);

  /// Adds the units of a plan that has grown: those behind the units of the table. Parameters keep
  /// their columns.
  void add_units(const CampaignPlan& plan);

  /// Throws ConfigError, with `key` of `file`, for an expression over the columns that SQLite does
  /// not understand.
  void check_expression(const std::string& file, const std::string& key,
                        const std::string& expression);

  /// Reads the results of units that have ended but have none in the table, as after a kill.
  void collect(const CampaignPlan& plan);
  /// The same. Forgets results of limits that were smaller than now, and reads scores again if
  /// other ones are asked for.
  void synchronize(const CampaignPlan& plan);

  /// Notes that a run of the campaign begins now, for the estimate of its duration.
  void begin_run();

  /// Adds the result with its scores.
  void add(const CampaignUnit& unit, UnitResult result);

  [[nodiscard]] std::vector<const CampaignUnit*> units_without_result(const CampaignPlan& plan);

  /// Only the first `count` units are rows of the view from now on.
  void limit_rows(int count);

  /// Creates a temporary view with the columns of this campaign, of the results in another database
  /// that is attached as `schema`.
  void create_view_of(const std::string& schema, const std::string& view);

  [[nodiscard]] Database& database() { return database_; }

 private:
  void create_tables();
  void name_columns(const CampaignPlan& plan);
  [[nodiscard]] std::string view_text(const std::string& schema) const;
  void check_expressions(const std::string& file);
  void classify(UnitResult& result) const;
  void forget_exceeded_limits(const CampaignPlan& plan);
  void set_text(const std::string& key, const std::string& value);
  std::string text_of(const std::string& key);

  CampaignFolder folder_;
  CampaignDefinition definition_;
  Database database_;
  std::string columns_;  ///< of parameters and scores, in SQL
};

/// The columns of the view before parameters and scores; none of these can have such a name.
const std::vector<std::string>& reserved_columns();

}  // namespace adit

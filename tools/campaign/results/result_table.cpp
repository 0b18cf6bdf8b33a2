// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "tools/campaign/results/result_table.hpp"

#include <algorithm>
#include <cstdint>
#include <set>
#include <utility>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "common/config/config.hpp"
#include "common/files/file_error.hpp"
#include "common/service/wall_time.hpp"
#include "tools/campaign/results/unit_scores.hpp"

namespace adit {
namespace {

constexpr const char* kTables = R"(
CREATE TABLE IF NOT EXISTS settings (key TEXT PRIMARY KEY, value);
CREATE TABLE IF NOT EXISTS units (
  number INTEGER PRIMARY KEY, id TEXT UNIQUE NOT NULL, parameters TEXT NOT NULL, command TEXT NOT NULL);
CREATE TABLE IF NOT EXISTS results (
  id TEXT PRIMARY KEY, state TEXT NOT NULL, reason TEXT NOT NULL, exit_code INTEGER,
  began_utime INTEGER NOT NULL, wall_s REAL NOT NULL, cpu_s REAL NOT NULL, memory_mb REAL NOT NULL,
  exceeded_limit REAL NOT NULL, host TEXT NOT NULL, scores TEXT NOT NULL);
)";

constexpr const char* kAddResult =
    "INSERT OR REPLACE INTO results VALUES (?, ?, ?, ?, ?, ?, ?, ?, ?, ?, ?)";

/// All names of parameters, in their order of first appearance.
std::vector<std::string> parameter_names(const CampaignPlan& plan) {
  std::vector<std::string> names;
  std::set<std::string> known;
  for (const CampaignUnit& unit : plan.units) {
    const auto values = nlohmann::json::parse(unit.parameters);
    for (const auto& [name, value] : values.items()) {
      if (known.insert(name).second) names.push_back(name);
    }
  }
  return names;
}

/// What the row of a result depends on beside the result.
std::string score_text(const CampaignDefinition& definition) {
  std::string text = fmt::format("{}\n", fmt::join(definition.exit_codes, " "));
  for (const ScoreDefinition& score : definition.scores) {
    text += fmt::format("{}\n{}\n{}\n{}\n", score.name, score.file, score.pointer, score.column);
  }
  return text;
}

}  // namespace

const std::vector<std::string>& reserved_columns() {
  static const std::vector<std::string> names{
      "unit",        "id",     "parameters", "command",   "state", "reason", "exit_code",
      "began_utime", "wall_s", "cpu_s",      "memory_mb", "host",  "scores"};
  return names;
}

ResultTable::ResultTable(const CampaignFolder& folder, const CampaignDefinition& definition,
                         const CampaignPlan& plan, const std::string& file,
                         const std::string& file_text)
    : folder_(folder),
      definition_(definition),
      database_(folder.database(), Database::Mode::kWrite) {
  SqlTransaction transaction(database_);
  create_tables();
  database_.execute("DELETE FROM units");
  add_units(plan);
  name_columns(plan);
  database_.execute("DROP VIEW IF EXISTS campaign; CREATE VIEW campaign AS " + view_text(""));
  set_text("name", definition.name);
  set_text("file", file_text);
  check_expressions(file);
  transaction.commit();
}

void ResultTable::create_tables() { database_.execute(kTables); }

void ResultTable::add_units(const CampaignPlan& plan) {
  SqlStatement count = database_.prepare("SELECT count(*) FROM units");
  count.step();
  SqlStatement insert = database_.prepare("INSERT INTO units VALUES (?, ?, ?, ?)");
  for (auto i = static_cast<std::size_t>(count.integer(0)); i < plan.units.size(); ++i) {
    const CampaignUnit& unit = plan.units[i];
    insert.bind(0, std::int64_t{unit.number});
    insert.bind(1, unit.id);
    insert.bind(2, unit.parameters);
    insert.bind(3, shell_line(plan, unit, "repeat_" + unit.id));
    insert.step();
    insert.reset();
  }
  limit_rows(static_cast<int>(plan.units.size()));
}

void ResultTable::name_columns(const CampaignPlan& plan) {
  std::set<std::string> used(reserved_columns().begin(), reserved_columns().end());
  const auto add = [&](const std::string& source, const std::string& name) {
    if (!used.insert(name).second)
      throw ConfigError(fmt::format(
          "the name {} is used twice: by a parameter, a score or a column of all campaigns", name));
    columns_ += fmt::format(R"(, json_extract({}, '$.{}') AS "{}")", source, name, name);
  };
  for (const std::string& name : parameter_names(plan)) add("parameters", name);
  for (const ScoreDefinition& score : definition_.scores) add("scores", score.name);
}

std::string ResultTable::view_text(const std::string& schema) const {
  return fmt::format(
      "SELECT number AS unit, id, parameters, command, state, reason, exit_code, began_utime, "
      "wall_s, "
      "cpu_s, memory_mb, host, scores{1} FROM {0}units LEFT JOIN {0}results USING (id) WHERE "
      "number <= "
      "(SELECT value FROM {0}settings WHERE key = 'rows')",
      schema, columns_);
}

void ResultTable::create_view_of(const std::string& schema, const std::string& view) {
  database_.execute(fmt::format("DROP VIEW IF EXISTS {0}; CREATE TEMP VIEW {0} AS {1}", view,
                                view_text(schema + ".")));
}

void ResultTable::check_expression(const std::string& file, const std::string& key,
                                   const std::string& expression) {
  if (expression.empty()) return;
  try {
    database_.prepare(fmt::format("SELECT ({}\n) FROM campaign", expression));
  } catch (const FileError& error) {
    const std::string text = error.what();
    const auto at = text.find(": ");
    throw ConfigError(
        fmt::format("{}: {}: {}", file, key, at == std::string::npos ? text : text.substr(at + 2)));
  }
}

void ResultTable::check_expressions(const std::string& file) {
  const auto check = [&](const std::string& key, const std::string& expression) {
    check_expression(file, "campaign." + key, expression);
  };
  for (std::size_t i = 0; i < definition_.rates.size(); ++i) {
    check(fmt::format("rates[{}].condition", i), definition_.rates[i].condition);
    check(fmt::format("rates[{}].given", i), definition_.rates[i].given);
  }
  for (std::size_t i = 0; i < definition_.distributions.size(); ++i)
    check(fmt::format("distributions[{}].value", i), definition_.distributions[i].value);
  check("worst", definition_.worst);
}

void ResultTable::synchronize(const CampaignPlan& plan) {
  SqlTransaction transaction(database_);
  forget_exceeded_limits(plan);
  const std::string scores = score_text(definition_);
  if (text_of("scores") != scores)             // read again below
    database_.execute("DELETE FROM results");  // of other plans, too
  set_text("scores", scores);
  collect(plan);
  transaction.commit();
}

void ResultTable::collect(const CampaignPlan& plan) {
  for (const CampaignUnit* const unit : units_without_result(plan)) {
    if (auto result = read_result(folder_.result(unit->id))) add(*unit, std::move(*result));
  }
}

/// These units, and those that were lost or could not be started, run again.
void ResultTable::forget_exceeded_limits(const CampaignPlan& plan) {
  SqlStatement forgotten = database_.prepare(
      "SELECT id FROM results WHERE (state = 'time limit' AND exceeded_limit < ?) OR "
      "(state = 'memory limit' AND exceeded_limit < ?) OR state IN ('lost', 'not started')");
  forgotten.bind(0, plan.time_max_s);
  forgotten.bind(1, plan.memory_max_mb);
  std::vector<std::string> ids;
  while (forgotten.step()) ids.push_back(forgotten.text(0));
  SqlStatement remove = database_.prepare("DELETE FROM results WHERE id = ?");
  for (const std::string& id : ids) {
    std::filesystem::remove_all(folder_.unit(id));
    remove.bind(0, id);
    remove.step();
    remove.reset();
  }
}

/// By the exit codes that count now, which may not be those with which the unit ran.
void ResultTable::classify(UnitResult& result) const {
  const bool ended = result.state == UnitState::kEnded || result.state == UnitState::kCrashed;
  if (!ended || !result.exit_code) return;
  const bool accepted = definition_.accepts(*result.exit_code);
  result.state = accepted ? UnitState::kEnded : UnitState::kCrashed;
  result.reason = accepted ? "" : fmt::format("ended with exit code {}", *result.exit_code);
}

void ResultTable::add(const CampaignUnit& unit, UnitResult result) {
  classify(result);
  UnitScores scores{"{}", ""};
  if (result.state == UnitState::kEnded)
    scores = read_scores(definition_.scores, folder_.output(unit.id), unit.parameters);
  if (!scores.failure.empty()) {
    result.state = UnitState::kNoScore;
    result.reason = scores.failure;
  }
  SqlStatement insert = database_.prepare(kAddResult);
  insert.bind(0, unit.id);
  insert.bind(1, name_of(result.state));
  insert.bind(2, result.reason);
  if (result.exit_code) insert.bind(3, std::int64_t{*result.exit_code});
  insert.bind(4, result.began_utime);
  insert.bind(5, result.wall_s);
  insert.bind(6, result.cpu_s);
  insert.bind(7, result.memory_mb);
  insert.bind(8, result.limit);
  insert.bind(9, result.host);
  insert.bind(10, scores.json);
  insert.step();
}

void ResultTable::begin_run() {
  SqlStatement set = database_.prepare(
      "INSERT OR REPLACE INTO settings VALUES ('run_began_utime', ?), ('run_began_with', (SELECT "
      "count(*) FROM units JOIN results USING (id)))");
  set.bind(0, wall_utime());
  set.step();
}

std::vector<const CampaignUnit*> ResultTable::units_without_result(const CampaignPlan& plan) {
  SqlStatement missing = database_.prepare(
      "SELECT number FROM units WHERE id NOT IN (SELECT id FROM results) ORDER BY number");
  std::vector<const CampaignUnit*> units;
  while (missing.step())
    units.push_back(&plan.units.at(static_cast<std::size_t>(missing.integer(0)) - 1));
  return units;
}

void ResultTable::limit_rows(int count) {
  SqlStatement set = database_.prepare("INSERT OR REPLACE INTO settings VALUES ('rows', ?)");
  set.bind(0, std::int64_t{count});
  set.step();
}

void ResultTable::set_text(const std::string& key, const std::string& value) {
  SqlStatement set = database_.prepare("INSERT OR REPLACE INTO settings VALUES (?, ?)");
  set.bind(0, key);
  set.bind(1, value);
  set.step();
}

std::string ResultTable::text_of(const std::string& key) {
  SqlStatement get = database_.prepare("SELECT value FROM settings WHERE key = ?");
  get.bind(0, key);
  return get.step() ? get.text(0) : "";
}

}  // namespace adit

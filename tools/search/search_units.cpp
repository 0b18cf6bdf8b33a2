// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "tools/search/search_units.hpp"

#include <cctype>
#include <stdexcept>
#include <utility>

#include <fmt/format.h>

#include "common/config/config_file.hpp"
#include "common/files/file_utils.hpp"
#include "tools/database/database.hpp"

namespace adit {
namespace {

/// The plan with the unit of the simplest parameters, which names the columns of the table.
CampaignPlan first_plan(const SearchFile& file, UnitMaker& maker) {
  CampaignPlan plan = plan_without_units(file.campaign, file.name, file.folder);
  plan.units.push_back(maker.unit(file.space.values(file.space.simplest())));
  plan.units.back().number = 1;
  return plan;
}

std::string kind_of(const std::string& state, const std::string& reason, std::optional<bool> fails,
                    const std::string& kind) {
  if (state != "ended") return without_numbers(fmt::format("{}: {}", state, reason));
  if (!fails) return "the condition of a failure has no value";
  if (!*fails) return "";
  return kind.empty() ? "failure" : without_numbers(kind);
}

std::string expression_or(const std::string& expression, const char* otherwise) {
  return expression.empty() ? otherwise : expression;
}

}  // namespace

std::string without_numbers(const std::string& text) {
  const auto is_digit = [&](std::size_t i) {
    return i < text.size() && std::isdigit(static_cast<unsigned char>(text[i])) != 0;
  };
  std::string result;
  for (std::size_t i = 0; i < text.size(); ++i) {
    if (!is_digit(i)) {
      result += text[i];
      continue;
    }
    while (is_digit(i + 1) || (i + 1 < text.size() && text[i + 1] == '.' && is_digit(i + 2))) ++i;
    result += '#';
  }
  return result;
}

SearchFile load_search_file(const std::filesystem::path& path) {
  const ConfigFile file = ConfigFile::load(path);
  return {.name = path.string(),
          .text = read_text_file(path),
          .folder = std::filesystem::absolute(path).parent_path().lexically_normal(),
          .campaign = load_campaign(file, {"search", "space"}),
          .search = load_search(file),
          .space = load_space(file)};
}

SearchUnits::SearchUnits(const SearchFile& file, const CampaignFolder& folder,
                         const std::filesystem::path& programs)
    : file_(file),
      folder_(folder),
      lock_(folder.lock()),
      maker_(file.campaign, file.name, file.folder, programs),
      plan_(first_plan(file, maker_)),
      points_{file.space.simplest()},
      ids_{{plan_.units.front().id, 0}},
      table_(folder, file.campaign, plan_, file.name, file.text) {
  table_.check_expression(file.name, "search.failure", file.search.failure);
  table_.check_expression(file.name, "search.severity", file.search.severity);
  table_.check_expression(file.name, "search.kind", file.search.kind);
  folder_.remove_old_attempts();
  table_.synchronize(plan_);
}

std::size_t SearchUnits::add_point(const SearchPoint& point) {
  CampaignUnit unit = maker_.unit(file_.space.values(point));
  const auto [entry, is_new] = ids_.try_emplace(unit.id, plan_.units.size());
  if (!is_new) return entry->second;
  unit.number = static_cast<int>(plan_.units.size()) + 1;
  plan_.units.push_back(std::move(unit));
  points_.push_back(point);
  return entry->second;
}

std::vector<SearchUnit> SearchUnits::read(const std::string& condition) {
  SqlStatement row = table_.database().prepare(fmt::format(
      "SELECT unit, state, reason, ({}\n), ({}\n), ({}\n), cpu_s FROM campaign WHERE state IS NOT "
      "NULL AND {} ORDER BY unit",
      file_.search.failure, expression_or(file_.search.severity, "NULL"),
      expression_or(file_.search.kind, "''"), condition));
  std::vector<SearchUnit> units;
  while (row.step()) {
    if (row.text(1) == "not started") throw std::runtime_error(row.text(2));
    const auto index = static_cast<std::size_t>(row.integer(0)) - 1;
    SearchUnit unit;
    unit.unit = &plan_.units[index];
    unit.point = points_[index];
    unit.cpu_s = row.number(6);
    if (row.is_number(4)) unit.evaluation.severity = row.number(4);
    unit.evaluation.kind = kind_of(row.text(1), row.text(2), row.truth(3), row.text(5));
    units.push_back(std::move(unit));
  }
  return units;
}

std::vector<std::size_t> SearchUnits::add(const std::vector<SearchPoint>& points) {
  std::vector<std::size_t> units;
  for (const SearchPoint& point : points) units.push_back(add_point(point));
  SqlTransaction transaction(table_.database());
  table_.add_units(plan_);
  table_.collect(plan_);
  transaction.commit();
  return units;
}

bool SearchUnits::run(const LocalRunner& runner, const OnUnit& on_unit) {
  const std::vector<const CampaignUnit*> missing = table_.units_without_result(plan_);
  std::size_t count = 0;
  const auto on_result = [&](const CampaignUnit& unit, const UnitResult& result) {
    table_.add(unit, result);
    ++count;
    return on_unit(read(fmt::format("unit = {}", unit.number)).front());
  };
  return runner.run(plan_, missing, folder_, on_result) && count == missing.size();
}

std::vector<SearchUnit> SearchUnits::with_result() { return read("true"); }

}  // namespace adit

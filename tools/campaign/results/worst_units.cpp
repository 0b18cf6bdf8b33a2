// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "tools/campaign/results/worst_units.hpp"

#include <cstdint>

#include <fmt/format.h>

#include "tools/campaign/results/rates.hpp"

namespace adit {
namespace {

constexpr int kFixedColumns = 8;

}  // namespace

std::vector<WorstUnit> worst_units(const CampaignDefinition& definition, Database& database,
                                   int count) {
  std::vector<std::string> names;
  std::string violations;
  std::string sum = "0 + 0";  // a single number in ORDER BY would name a column
  for (const RateDefinition& rate : definition.rates) {
    const std::string violation = violation_of(rate);
    if (violation.empty()) continue;
    names.push_back(rate.name);
    violations += fmt::format(", {}", violation);
    sum += fmt::format(" + {}", violation);
  }
  const std::string worst =
      definition.worst.empty() ? "NULL" : fmt::format("({}\n)", definition.worst);
  SqlStatement rows = database.prepare(fmt::format(
      "SELECT unit, id, parameters, state, reason, scores, command, {} AS worst_value{} FROM "
      "campaign "
      "WHERE "
      "state IS NOT NULL ORDER BY {} DESC, state <> 'ended' DESC, worst_value DESC, unit LIMIT ?",
      worst, violations, sum));
  rows.bind(0, std::int64_t{count});
  std::vector<WorstUnit> units;
  while (rows.step()) {
    WorstUnit unit;
    unit.number = static_cast<int>(rows.integer(0));
    unit.id = rows.text(1);
    unit.parameters = rows.text(2);
    unit.state = rows.text(3);
    unit.reason = rows.text(4);
    unit.scores = rows.text(5);
    unit.command = rows.text(6);
    unit.value = rows.text(7);
    for (std::size_t i = 0; i < names.size(); ++i) {
      if (!rows.truth(kFixedColumns + static_cast<int>(i)).value_or(false)) continue;
      unit.violated += (unit.violations++ > 0 ? ", " : "") + names[i];
    }
    units.push_back(std::move(unit));
  }
  return units;
}

}  // namespace adit

// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "tools/campaign/results/comparison.hpp"

#include <fmt/format.h>

#include "common/files/file_error.hpp"
#include "tools/campaign/results/proportions.hpp"
#include "tools/campaign/run/campaign_folder.hpp"

namespace adit {
namespace {

constexpr const char* kEarlier = "earlier_campaign";

void add_pairs(RateComparison& comparison, Database& database) {
  const RateDefinition& rate = comparison.now.definition;
  const std::string given = rate.given.empty() ? "1" : fmt::format("({}\n)", rate.given);
  const int unknown = comparison.now.unknown_counts_as_yes() ? 1 : 0;
  const auto values = [&](const char* view) {
    return fmt::format(
        "(SELECT unit, id, parameters, coalesce(({}\n) <> 0, {}) AS c FROM {} WHERE state IS NOT "
        "NULL AND {})",
        rate.condition, unknown, view, given);
  };
  SqlStatement pairs = database.prepare(
      fmt::format("SELECT a.unit, a.id, a.parameters, a.c, b.c FROM {} AS a JOIN {} AS b USING "
                  "(parameters) ORDER BY a.unit",
                  values("campaign"), values(kEarlier)));
  while (pairs.step()) {
    ++comparison.pairs;
    const bool now = pairs.integer(3) != 0;
    if (now == (pairs.integer(4) != 0)) continue;
    ++(now ? comparison.only_now : comparison.only_earlier);
    comparison.changed.push_back(
        {static_cast<int>(pairs.integer(0)), pairs.text(1), pairs.text(2), now});
  }
  comparison.mcnemar_p = mcnemar_p(comparison.only_now, comparison.only_earlier);
}

}  // namespace

void require_campaign(const std::filesystem::path& folder) {
  if (!std::filesystem::exists(CampaignFolder{folder}.database()))
    throw FileError(fmt::format("{}: no campaign, there is no campaign.db", folder.string()));
}

std::vector<RateComparison> compare_campaigns(ResultTable& table,
                                              const CampaignDefinition& definition,
                                              const std::filesystem::path& earlier) {
  require_campaign(earlier);
  Database& database = table.database();
  SqlStatement attach = database.prepare("ATTACH ? AS earlier");
  attach.bind(0, CampaignFolder{earlier}.database().string());
  attach.step();
  table.create_view_of("earlier", kEarlier);
  const std::vector<Rate> now = measure_rates(definition, database);
  const std::vector<Rate> before = measure_rates(definition, database, kEarlier);
  std::vector<RateComparison> comparisons;
  for (std::size_t i = 0; i < now.size(); ++i) {
    RateComparison comparison;
    comparison.now = now[i];
    comparison.earlier = before[i];
    add_pairs(comparison, database);
    comparison.fisher_p = fisher_p(now[i].count(), now[i].counts.total(), before[i].count(),
                                   before[i].counts.total());
    comparisons.push_back(std::move(comparison));
  }
  return comparisons;
}

}  // namespace adit

// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "tools/campaign/results/rates.hpp"

#include <fmt/format.h>

namespace adit {
namespace {

bool has_bounds(const RateDefinition& rate) { return rate.min > 0.0 || rate.max < 1.0; }

bool only_max(const RateDefinition& rate) { return rate.min <= 0.0 && rate.max < 1.0; }

/// The line ends keep a comment in an expression from hiding what follows.
std::string given_of(const RateDefinition& rate) {
  return rate.given.empty() ? "1" : fmt::format("({}\n)", rate.given);
}

}  // namespace

bool Rate::unknown_counts_as_yes() const { return only_max(definition); }

int Rate::count() const { return counts.yes + (unknown_counts_as_yes() ? counts.unknown : 0); }

double Rate::share() const {
  return counts.total() > 0 ? static_cast<double>(count()) / counts.total() : 0.0;
}

ShareInterval Rate::interval() const { return wilson_interval(count(), counts.total()); }

RateVerdict Rate::verdict() const {
  if (!has_bounds(definition)) return RateVerdict::kNotAsked;
  if (counts.total() == 0) return RateVerdict::kNotCounted;
  if (share() < definition.min || share() > definition.max) return RateVerdict::kNotMet;
  const ShareInterval bounds = interval();
  const bool within = bounds.lower >= definition.min && bounds.upper <= definition.max;
  return within ? RateVerdict::kShown : RateVerdict::kMet;
}

std::vector<Rate> measure_rates(const CampaignDefinition& definition, Database& database,
                                const std::string& view) {
  std::vector<Rate> rates;
  for (const RateDefinition& rate : definition.rates) {
    SqlStatement counts = database.prepare(
        fmt::format("SELECT sum(c = 1), sum(c = 0), sum(c IS NULL) FROM "
                    "(SELECT ({}\n) <> 0 AS c FROM {} WHERE state IS NOT NULL AND {})",
                    rate.condition, view, given_of(rate)));
    counts.step();
    const auto count = [&](int column) { return static_cast<int>(counts.integer(column)); };
    rates.push_back({rate, {count(0), count(1), count(2)}});
  }
  return rates;
}

std::string violation_of(const RateDefinition& rate) {
  if (!has_bounds(rate)) return "";
  const char* const violates =
      only_max(rate) ? "({0}\n) IS NOT FALSE AND {1}" : "({0}\n) IS NOT TRUE AND {1}";
  return fmt::format(fmt::runtime(std::string("coalesce((") + violates + "), 0)"), rate.condition,
                     given_of(rate));
}

}  // namespace adit

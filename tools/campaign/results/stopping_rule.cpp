// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "tools/campaign/results/stopping_rule.hpp"

#include <algorithm>
#include <cstdint>

#include <fmt/format.h>

namespace adit {
namespace {

/// Of fewer units an interval can be narrow by chance.
constexpr int kUnitsMin = 20;

}  // namespace

StoppingRule::StoppingRule(const CampaignDefinition& definition, Database& database)
    : has_result_(database.prepare("SELECT state IS NOT NULL FROM campaign WHERE unit = ?")) {
  for (const RateDefinition& rate : definition.rates) {
    if (rate.stop_width <= 0.0) continue;
    watched_.push_back(
        {{rate, {}},
         database.prepare(fmt::format("SELECT ({}\n) <> 0, ({}\n) FROM campaign WHERE unit = ?",
                                      rate.condition, rate.given.empty() ? "1" : rate.given))});
  }
}

std::optional<int> StoppingRule::update() {
  while (!stop_ && !watched_.empty() && take_in(units_ + 1)) {
    ++units_;
    if (units_ >= kUnitsMin && is_satisfied()) stop_ = units_;
  }
  return stop_;
}

bool StoppingRule::take_in(int unit) {
  has_result_.reset();
  has_result_.bind(0, std::int64_t{unit});
  if (!has_result_.step() || !has_result_.truth(0).value_or(false)) return false;
  for (Watched& watched : watched_) {
    watched.values.reset();
    watched.values.bind(0, std::int64_t{unit});
    watched.values.step();
    if (!watched.values.truth(1).value_or(false)) continue;
    RateCounts& counts = watched.rate.counts;
    const std::optional<bool> value = watched.values.truth(0);
    ++(!value ? counts.unknown : *value ? counts.yes : counts.no);
  }
  return true;
}

bool StoppingRule::is_satisfied() const {
  return std::ranges::all_of(watched_, [](const Watched& watched) {
    return watched.rate.interval().width() < watched.rate.definition.stop_width;
  });
}

}  // namespace adit

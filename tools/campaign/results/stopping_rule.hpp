// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <vector>

#include "tools/campaign/definition/campaign_definition.hpp"
#include "tools/campaign/results/rates.hpp"
#include "tools/database/database.hpp"

namespace adit {

/// Decides when the rates with a `stop_width` are known well enough: after the first n units such
/// that the 95 % intervals of all of them are narrower (fixed-width sequential sampling: Chow and
/// Robbins, Annals of Mathematical Statistics 36, 1965). The units before n count, in their order:
/// units that end early are not a sample, since those that fail may take longer. The decision so
/// depends neither on the number of workers nor on the cluster.
class StoppingRule {
 public:
  /// `database` must outlive this.
  StoppingRule(const CampaignDefinition& definition, Database& database);

  /// Takes in the units that have a result now. Returns n once all intervals are narrow enough.
  std::optional<int> update();

 private:
  struct Watched {
    Rate rate;
    SqlStatement values;  ///< condition and given of one unit
  };

  bool take_in(int unit);
  [[nodiscard]] bool is_satisfied() const;

  std::vector<Watched> watched_;
  SqlStatement has_result_;
  int units_ = 0;
  std::optional<int> stop_;
};

}  // namespace adit

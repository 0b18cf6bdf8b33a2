// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include "common/config/bounds.hpp"
#include "common/config/config_file.hpp"

namespace adit {

/// What a search looks for and how long: section `search` of its file. Expressions are SQL over the
/// columns of the results, as those of a campaign.
struct SearchDefinition {
  std::string failure;   ///< true for a unit that fails; unknown (NULL) counts as true
  std::string severity;  ///< larger the closer a unit is to a failure; empty: no guidance
  std::string kind;      ///< text; failures with the same text but for numbers are of one kind
  int seed = 1;
  int batch = 16;              ///< units of one distribution
  int units_max = 400;         ///< before the failures are shrunk
  int kinds_max = 0;           ///< kinds after which the search ends; 0: no limit
  int shrink_max = 60;         ///< units that shrink one kind
  double uniform_share = 0.1;  ///< of a batch, drawn from the whole space

  template <class V>
  void visit(V& v) {
    v("failure", failure);
    v("severity", severity);
    v("kind", kind);
    v("seed", seed, at_least(0.0));
    v("batch", batch, within(1.0, 10'000.0));
    v("units_max", units_max, within(1.0, 1'000'000.0));
    v("kinds_max", kinds_max, at_least(0.0));
    v("shrink_max", shrink_max, at_least(0.0));
    v("uniform_share", uniform_share, within(0.0, 1.0));
  }
};

/// Loads the section `search`. Throws ConfigError.
SearchDefinition load_search(const ConfigFile& file);

}  // namespace adit

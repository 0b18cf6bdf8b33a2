// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "common/local_map/association.hpp"
#include "procs/mapping/association/trial.hpp"

namespace adit {

/// What the local maps themselves have to say, asked for again under each belief that is tried.
class Evidence {
 public:
  virtual ~Evidence() = default;

  /// The places that a map may have come back to, where the trial believes it to be: as many
  /// closures as are worth deciding, their ids without meaning. `thorough`: less likely places too.
  [[nodiscard]] virtual std::vector<Closure> closures(int map, Trial& trial,
                                                      bool thorough) const = 0;

  /// How unlikely the newest map is where it lies: −2 log-likelihood of what it shows against what
  /// older maps show of the same places; 0 where it agrees or shows what is new.
  [[nodiscard]] virtual double surprise(const std::vector<Pose2>& T_map_local) const = 0;
};

}  // namespace adit

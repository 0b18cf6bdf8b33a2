// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "sim/simulation/simulation_params.hpp"

namespace adit {

/// What is to happen to processes in the course of a run: those of the faults that are of this
/// kind, in order of time.
class ProcessFaults {
 public:
  explicit ProcessFaults(const std::vector<FaultDescription>& faults);

  struct Harm {
    std::string stage;  ///< that was killed or suspended, `adit-<stage>`
    std::string line;   ///< for people, with what came of it
  };

  /// Lets happen what is due that many seconds after the start.
  std::vector<Harm> advance(double elapsed_s);

 private:
  std::vector<FaultDescription> faults_;
  std::size_t next_ = 0;
};

}  // namespace adit

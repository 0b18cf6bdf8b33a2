// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include <sys/types.h>

#include "sim/simulation/simulation_params.hpp"

namespace adit {

/// Process ids of the descendants of a process, at any depth, whose executable has the name,
/// ascending. A process whose parent has ended is no descendant. Processes that end meanwhile or
/// cannot be read are skipped.
std::vector<pid_t> descendants_named(pid_t ancestor, const std::string& executable);

/// Process id of the starter of a process: its parent, or, if that is an adit-watch, the supervisor
/// above it. 0 if it cannot be read.
pid_t launcher_of(pid_t pid);

/// Sends the signal to all processes `executable` that descend from the starter of this process,
/// unless the starter is init. Returns the number of receivers.
int signal_siblings(const std::string& executable, int signal);

/// Injects the process faults of a run, in order of time.
class ProcessFaults {
 public:
  explicit ProcessFaults(const std::vector<FaultDescription>& faults);

  struct AppliedFault {
    std::string stage;  ///< the stage `adit-<stage>` that was killed or suspended
    std::string line;   ///< for people, with what came of it
  };

  /// Injects the faults that are due at this time after the start.
  std::vector<AppliedFault> advance(double elapsed_s);

 private:
  std::vector<FaultDescription> faults_;
  std::size_t next_ = 0;
};

}  // namespace adit

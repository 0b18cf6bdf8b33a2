// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include <sys/types.h>

#include "sim/simulation/simulation_params.hpp"

namespace adit {

/// Processes that descend from one, at whatever depth, and whose executable has the name, in
/// ascending order. One whose parent ended no longer descends from it. Processes that end
/// meanwhile, or of which nothing may be known, are left out.
std::vector<pid_t> descendants_named(pid_t ancestor, const std::string& executable);

/// Who started a process: its parent, or where that is an adit-watch, the supervisor that has it. 0
/// where nothing may be known.
pid_t launcher_of(pid_t pid);

/// Sends the signal to all processes `executable` that were started beside this one: that descend
/// from its starter. To none where that is init, from which everybody descends. Returns how many it
/// was sent to.
int signal_siblings(const std::string& executable, int signal);

/// What is to happen to processes in the course of a run: those of the faults that are of this
/// kind, in order of time.
class ProcessFaults {
 public:
  explicit ProcessFaults(const std::vector<FaultDescription>& faults);

  struct AppliedFault {
    std::string stage;  ///< that was killed or suspended, `adit-<stage>`
    std::string line;   ///< for people, with what came of it
  };

  /// Lets happen what is due that many seconds after the start.
  std::vector<AppliedFault> advance(double elapsed_s);

 private:
  std::vector<FaultDescription> faults_;
  std::size_t next_ = 0;
};

}  // namespace adit

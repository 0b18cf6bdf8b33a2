// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include "common/procman/procman_values.hpp"
#include "procs/supervisor/keeper.hpp"

namespace adit {

/// How a process is, in procman's words.
ProcmanStatus procman_status(const KeptProcess& process);

/// Hands on what processes print, to who shows it elsewhere: of each the newest 8 kB at a time, and
/// how many lines were left out, so that one that floods does not fill the network.
class OutputRelay {
 public:
  /// What is new since the last call, in messages of less than 60 kB. `utime` is wall_utime().
  std::vector<ProcmanOutput> take(const Keeper& keeper, const std::string& deputy,
                                  std::int64_t utime);

 private:
  std::map<std::string, std::int64_t> sent_lines_;  // by process
};

}  // namespace adit

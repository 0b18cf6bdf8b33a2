// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <string>

#include "common/process_list/process_list.hpp"
#include "procs/supervisor/os/rotated_file.hpp"
#include "procs/supervisor/supervisor_params.hpp"

namespace adit {

/// What a supervisor is to be, with everything that the configuration leaves open filled in.
struct SupervisorSite {
  ProcessList list;  ///< each command with its deputy
  std::string deputy;
  bool in_charge = true;
  std::filesystem::path socket;
  std::filesystem::path watcher;
  std::filesystem::path log_dir;  ///< empty: what processes print is kept in no files
  RotatedFile::Limits log_limits;
};

/// Reads the process list, and makes the folder for logs. A command without a deputy, or with
/// procman's "localhost", is that of the one in charge. Throws ConfigError where there is no list,
/// or no one in charge for such a command, or no such script, or no such folder.
SupervisorSite make_site(const SupervisorParams& params);

}  // namespace adit

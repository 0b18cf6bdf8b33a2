// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <string>

#include "common/config/bounds.hpp"
#include "common/process_list/process_list.hpp"
#include "procs/supervisor/management/process_lifecycle.hpp"
#include "procs/supervisor/os/process_log.hpp"

namespace adit {

struct SupervisorParams {
  std::string processes;           ///< file with the process list; there is none without
  std::string deputy_id;           ///< whose commands run here; empty: the name of this computer
  std::string role = "in_charge";  ///< or "deputy", which obeys the one in charge
  std::string in_charge;       ///< of a deputy: the deputy_id of the one in charge; empty: nobody
  bool accept_orders = false;  ///< whether anybody on the network may start and stop processes
  std::string start_script;    ///< to run at the start; empty: nothing starts by itself
  double script_timeout_s = 30.0;  ///< for waits in scripts that name no time
  std::string socket;              ///< for `adit ps` and the like; empty: the default of this user
  std::string watcher;             ///< adit-watch; empty: the one beside this program
  std::string log_dir;             ///< for what processes print, a file for each; empty: nowhere
  double log_file_max_mb = 4.0;    ///< of one file, before it is put aside
  int log_files = 5;               ///< of each process, the oldest go
  RestartBackoff restart;

  template <class V>
  void visit(V& v) {
    v("processes", processes);
    v("deputy_id", deputy_id);
    v("role", role, OneOf({"in_charge", "deputy"}));
    v("in_charge", in_charge);
    v("accept_orders", accept_orders);
    v("start_script", start_script);
    v("script_timeout_s", script_timeout_s, at_least(0.0));
    v("socket", socket);
    v("watcher", watcher);
    v("log_dir", log_dir);
    v("log_file_max_mb", log_file_max_mb, within(0.01, 1000.0));
    v("log_files", log_files, within(1, 100));
    v("restart", restart);
  }
};

/// What a supervisor is to be, with everything that the configuration leaves open filled in.
struct SupervisorSetup {
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
SupervisorSetup make_setup(const SupervisorParams& params);

}  // namespace adit

// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <string>

#include "common/config/bounds.hpp"
#include "common/process_list/process_list.hpp"
#include "procs/supervisor/management/process_lifecycle.hpp"
#include "procs/supervisor/os/process_log.hpp"
#include "procs/supervisor/procman/name_claim.hpp"

namespace adit {

struct SupervisorParams {
  std::string processes;           ///< file of the process list; required
  std::string deputy_id;           ///< commands of this deputy run here; empty: the host name
  std::string role = "in_charge";  ///< or "deputy", which accepts orders of in_charge
  std::string in_charge;       ///< for a deputy: deputy_id of the supervisor in charge; empty: none
  bool accept_orders = false;  ///< accept orders of any sheriff on the network
  std::string start_script;    ///< script to run at startup; empty: none
  double script_timeout_s = 30.0;  ///< for script waits without timeout_s
  std::string socket;              ///< control socket; empty: default_socket_path()
  std::string watcher;             ///< path of adit-watch; empty: in the folder of this program
  std::string log_dir;             ///< folder of the process logs; empty: no logs
  double log_file_max_mb = 4.0;    ///< maximum size of a log file before rotation
  int log_files = 5;               ///< log files per process, the current one included
  RestartBackoff restart;
  double listen_s = NameClaim::kListenS;  ///< before the start: for another of the same name

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
    v("listen_s", listen_s, within(0.0, 60.0));
  }
};

/// Configuration of a supervisor with the defaults resolved and the process list loaded.
struct SupervisorSetup {
  ProcessList list;  ///< every command has a deputy
  std::string deputy;
  bool in_charge = true;
  std::filesystem::path socket;
  std::filesystem::path watcher;
  std::filesystem::path log_dir;  ///< empty: no log files
  RotatedFile::Limits log_limits;
};

/// Loads the process list and creates the log folder. A command without a deputy, or with procman's
/// "localhost", is assigned to the supervisor in charge. Throws ConfigError if the list is missing
/// or invalid, the supervisor in charge is needed and not set, the start script is not in the list,
/// adit-watch is not executable or the log folder is not writable.
SupervisorSetup make_setup(const SupervisorParams& params);

}  // namespace adit

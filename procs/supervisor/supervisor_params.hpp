// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include "common/config/bounds.hpp"
#include "procs/supervisor/keeping/process_life.hpp"

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
  RestartPace restart;

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

}  // namespace adit

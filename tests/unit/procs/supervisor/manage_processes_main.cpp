// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
// manage_processes WATCHER COMMAND_LINE: a keeper of one process, to be killed by a test. It ends
// with the test: one left over would hold its output open, for which who runs the tests waits.
#include <chrono>
#include <csignal>
#include <string>
#include <thread>

#include <sys/prctl.h>

#include "procs/supervisor/os/wall_time.hpp"
#include "procs/supervisor/process_manager.hpp"

int main(int, char** argv) {
  prctl(PR_SET_PDEATHSIG, SIGKILL);
  adit::ProcessList list;
  list.commands.emplace_back();
  list.commands[0].id = "kept";
  list.commands[0].exec = argv[2];
  adit::ProcessManager process_manager(list, {"", argv[1], {}});
  process_manager.find("kept")->start();
  for (;;) {
    process_manager.advance(adit::steady_us(), [](const std::string&) { return true; });
    std::this_thread::sleep_for(std::chrono::milliseconds(5));
  }
}

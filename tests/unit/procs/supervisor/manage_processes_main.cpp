// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
// manage_processes WATCHER COMMAND_LINE: a ProcessManager of one process, killed by a test. Ends
// with the test: a remaining process would hold the output open, for which ctest waits.
#include <chrono>
#include <csignal>
#include <string>
#include <thread>

#include <sys/prctl.h>

#include "common/service/wall_time.hpp"
#include "procs/supervisor/process_manager.hpp"

int main(int, char** argv) {
  prctl(PR_SET_PDEATHSIG, SIGKILL);
  adit::ProcessList list;
  list.commands.emplace_back();
  list.commands[0].id = "managed";
  list.commands[0].exec = argv[2];
  adit::ProcessManager process_manager(list, {"", argv[1], {}});
  process_manager.find("managed")->start();
  for (;;) {
    process_manager.advance(adit::steady_us(), [](const std::string&) { return true; });
    std::this_thread::sleep_for(std::chrono::milliseconds(5));
  }
}

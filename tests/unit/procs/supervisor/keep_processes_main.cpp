// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
// keep_processes WATCHER COMMAND_LINE: a keeper of one process, to be killed by a test.
#include <chrono>
#include <string>
#include <thread>

#include "procs/supervisor/keeper.hpp"
#include "procs/supervisor/os/wall_time.hpp"

int main(int, char** argv) {
  adit::ProcessList list;
  list.commands.emplace_back();
  list.commands[0].id = "kept";
  list.commands[0].exec = argv[2];
  adit::Keeper keeper(list, {"", argv[1], {}});
  keeper.find("kept")->start();
  for (;;) {
    keeper.advance(adit::steady_us(), [](const std::string&) { return true; });
    std::this_thread::sleep_for(std::chrono::milliseconds(5));
  }
}

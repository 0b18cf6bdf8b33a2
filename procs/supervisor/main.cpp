// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "common/bus/run_node.hpp"
#include "procs/supervisor/os/reload_signal.hpp"
#include "procs/supervisor/supervisor_node.hpp"

int main(int argc, char** argv) {
  adit::ReloadSignal::block();
  return adit::run_node<adit::SupervisorNode>("supervisor", argc, argv);
}

// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "common/bus/node/run_node.hpp"
#include "procs/supervisor/os/daemon.hpp"
#include "procs/supervisor/supervisor_node.hpp"

int main(int argc, char** argv) {
  adit::ReloadSignal::block();
  return adit::run_node<adit::SupervisorNode>("supervisor", argc, argv);
}

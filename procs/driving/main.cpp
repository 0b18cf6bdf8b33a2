// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "common/bus/node/run_node.hpp"
#include "procs/driving/driving_node.hpp"

int main(int argc, char** argv) { return adit::run_node<adit::DrivingNode>("driving", argc, argv); }

// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "drivers/base_serial/base_serial_node.hpp"

int main(int argc, char** argv) {
  return adit::run_node<adit::BaseSerialNode>("base_serial", argc, argv);
}

// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "drivers/tilt/tilt_node.hpp"

int main(int argc, char** argv) {
  return adit::run_device_driver<adit::TiltNode>("tilt", {"front", "rear"}, argc, argv);
}

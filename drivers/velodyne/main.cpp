// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "drivers/laser/laser_device_node.hpp"
#include "drivers/velodyne/velodyne.hpp"

int main(int argc, char** argv) {
  return adit::run_laser_driver<adit::Velodyne>("velodyne", argc, argv);
}

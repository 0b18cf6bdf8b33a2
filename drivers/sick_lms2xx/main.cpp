// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "drivers/laser/laser_device_node.hpp"
#include "drivers/sick_lms2xx/sick_lms2xx.hpp"

int main(int argc, char** argv) {
  return adit::run_laser_driver<adit::SickLms2xx>("sick_lms2xx", argc, argv);
}

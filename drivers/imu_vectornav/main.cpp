// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "drivers/imu_vectornav/imu_vectornav_node.hpp"

int main(int argc, char** argv) {
  return adit::run_node<adit::ImuVectorNavNode>("imu_vectornav", argc, argv);
}

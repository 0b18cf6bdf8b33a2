// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
// write_mission_log LOG: the log of a small synthetic mission, in a tunnel 4 m wide along x.
#include "tests/unit/tools/report/synthetic_mission_log.hpp"

int main(int argc, char** argv) {
  if (argc != 2) return 2;
  adit::test::write_mission_log(argv[1]);
  return 0;
}

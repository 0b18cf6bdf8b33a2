// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "tools/adit/mission_teller.hpp"

#include <cstdio>
#include <iostream>

#include <unistd.h>

namespace adit {
namespace {

constexpr double kLineEachS = 10.0;

}  // namespace

MissionTeller::MissionTeller() : on_terminal_(isatty(STDOUT_FILENO) == 1) {}

void MissionTeller::update(const MissionProgress& progress, double wall_s) {
  const double factor = wall_s > 0.0 ? progress.simulated_s / wall_s : 0.0;
  if (on_terminal_) {
    std::printf("\r%s ", progress_text(progress, factor).c_str());
  } else if (wall_s >= next_s_) {
    std::printf("%s\n", progress_text(progress, factor).c_str());
    next_s_ = wall_s + kLineEachS;
  }
  std::fflush(stdout);
}

void MissionTeller::say(const std::string& what) const {
  if (on_terminal_) std::printf("\n");
  std::fflush(stdout);
  std::cerr << "adit mission: " << what << std::endl;
}

void MissionTeller::end(const MissionProgress& last, const std::string& trouble, double wall_s) {
  std::printf("\n%s\n%.0f s of simulated time in %.0f s; %.2f m from the start at the end\n",
              trouble.empty() ? last.phase.reason.c_str() : trouble.c_str(), last.simulated_s,
              wall_s, last.from_start_m);
  std::fflush(stdout);
}

}  // namespace adit

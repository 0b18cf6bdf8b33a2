// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "tools/mission/mission_progress.hpp"

#include <array>
#include <cstdio>

namespace adit {
namespace {

const char* name_of(Phase phase) {
  constexpr std::array kNames{"waiting", "explore", "scan", "plan", "execute", "paused", "ended"};
  return kNames.at(static_cast<std::size_t>(phase));
}

}  // namespace

std::string progress_text(const MissionProgress& progress, double factor) {
  const MissionPhase& phase = progress.phase;
  std::array<char, 192> text{};
  std::snprintf(text.data(), text.size(),
                "%6.0f s  %-8s %s  %6.1f m driven, %6.1f m from the start, %3d local maps, "
                "%3d scans, %.1f x real time",
                progress.simulated_s, name_of(phase.phase),
                phase.homeward ? "homeward" : "outbound", phase.travelled_m, progress.from_start_m,
                progress.local_maps, phase.scans, factor);
  return text.data();
}

}  // namespace adit

// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <filesystem>
#include <fstream>
#include <functional>
#include <string>

#include "common/bus/bus.hpp"
#include "common/types/mission.hpp"

namespace adit {

/// Progress of a mission.
struct MissionProgress {
  MissionPhase phase;
  double simulated_s = 0.0;
  double distance_from_start_m = 0.0;  ///< straight-line distance of the true pose
  int local_maps = 0;
};

/// Progress as one line; `factor` is the speed in multiples of real time.
std::string progress_text(const MissionProgress& progress, double factor);

/// Appends each change of phase and each new stop reason to a file of tab-separated values: time
/// [s], number of the phase, "out" or "home", goal, frontier, laser, distance travelled [m],
/// remaining distance [m], reason.
class PhaseTrace {
 public:
  /// `bus` must outlive this. `now_s` returns the time of a line.
  PhaseTrace(Bus& bus, const std::filesystem::path& file, std::function<double()> now_s);
  PhaseTrace(const PhaseTrace&) = delete;
  PhaseTrace& operator=(const PhaseTrace&) = delete;

 private:
  void write(const MissionPhase& phase);

  std::ofstream file_;
  std::function<double()> now_s_;
  std::int32_t sequence_ = 0;
  std::string stop_;
};

}  // namespace adit

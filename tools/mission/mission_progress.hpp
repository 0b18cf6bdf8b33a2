// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <fstream>
#include <functional>
#include <string>

#include "common/bus/bus.hpp"
#include "common/types/mission.hpp"

namespace adit {

/// How a mission stands, for a line of progress.
struct MissionProgress {
  MissionPhase phase;
  double simulated_s = 0.0;
  double distance_from_start_m = 0.0;  ///< of the true body, straight
  int local_maps = 0;
};

/// One line; `factor` is how many times real time it goes.
std::string progress_text(const MissionProgress& progress, double factor);

/// Writes each change of phase, and each new reason to stop, as a line of tab-separated values:
/// time [s], phase as its number, out or home, goal, stub, laser, way driven and left [m], reason.
/// What a file of that name holds already stays.
class PhaseTrace {
 public:
  /// `bus` must outlive this. `now_s` is the time of a line.
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

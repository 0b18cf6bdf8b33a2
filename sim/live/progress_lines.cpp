// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "sim/live/progress_lines.hpp"

#include <array>
#include <cstdio>
#include <iostream>

#include "common/sensing/seconds.hpp"

namespace adit {
namespace {

std::string state_of(const RunState& run, const VehicleState& vehicle) {
  if (!run.failure.empty()) return "failed: " + run.failure;
  if (vehicle.stopped) return "held by a stop order";
  if (vehicle.expired) return "without a command";
  return "driving";
}

}  // namespace

std::string progress_line(double elapsed_s, double factor, const RunState& run,
                          const VehicleState& vehicle) {
  std::array<char, 96> numbers{};
  std::snprintf(numbers.data(), numbers.size(), "%.1f s simulated, %.1f x real time, %.1f m, ",
                elapsed_s, factor, run.travelled_m);
  return numbers.data() + state_of(run, vehicle);
}

void ProgressLines::update(const Simulation& simulation, std::int64_t start_utime,
                           std::int64_t wall_us) {
  const std::string& failure = simulation.state().failure;
  if (!failure.empty() && !failed_) say("the run has failed: " + failure);
  failed_ = !failure.empty();

  const std::int64_t utime = simulation.utime();
  if (!last_) last_ = {utime, wall_us};
  if (wall_us - last_->wall_us < kPeriodUs) return;
  const double factor =
      static_cast<double>(utime - last_->utime) / static_cast<double>(wall_us - last_->wall_us);
  last_ = {utime, wall_us};
  say(progress_line(seconds(utime - start_utime), factor, simulation.state(),
                    simulation.vehicle().state()));
}

void ProgressLines::say(const std::string& what) const {
  std::cerr << program_ + ": " + what + "\n" << std::flush;
}

}  // namespace adit

// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "sim/simulation/simulation.hpp"

namespace adit {

/// Tells on standard error how a run goes: a line every few seconds of wall time, and one when it
/// has failed.
class ProgressLines {
 public:
  static constexpr std::int64_t kPeriodUs = 5'000'000;

  explicit ProgressLines(std::string program) : program_(std::move(program)) {}

  /// Wall time is any that goes on steadily [µs].
  void update(const Simulation& simulation, std::int64_t start_utime, std::int64_t wall_us);

  /// One line, whenever.
  void say(const std::string& what) const;

 private:
  struct Mark {
    std::int64_t utime;
    std::int64_t wall_us;
  };

  std::string program_;
  std::optional<Mark> last_;
  bool failed_ = false;
};

/// `83.4 s simulated, 7.9 x real time, 31.2 m, driving`.
std::string progress_line(double elapsed_s, double factor, const RunState& run,
                          const VehicleState& vehicle);

}  // namespace adit

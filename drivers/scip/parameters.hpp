// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "drivers/scip/response.hpp"

#include "common/messages/result.hpp"

namespace adit {

/// What the laser says of itself, response PP.
struct ScipParameters {
  std::string model;
  int range_min_mm = 0;
  int range_max_mm = 0;
  int steps_per_turn = 0;
  int first_step = 0;
  int last_step = 0;
  int front_step = 0;  ///< straight ahead; steps increase counter-clockwise
  int scans_per_minute = 0;

  [[nodiscard]] double step_rad() const;
  [[nodiscard]] double bearing_rad(int step) const { return (step - front_step) * step_rad(); }
  [[nodiscard]] double scan_period_us() const { return 60e6 / scans_per_minute; }
};

/// Rejects a response without one of the numbers, or with numbers that contradict each other.
Result<ScipParameters> read_parameters(const ScipResponse& response);

/// The scan in a response MD, MS, GD or GS.
struct ScipReadings {
  std::uint32_t time_ms = 0;          ///< of the laser, 24 bits
  std::vector<std::uint32_t> raw_mm;  ///< distances, or codes below range_min_mm
};

/// `characters` for each distance, 2 or 3. Rejects other lengths and characters that encode no
/// number.
Result<ScipReadings> read_readings(const ScipResponse& response, std::size_t characters);

/// The time in a response TM1 [ms]; nothing if it has none.
std::optional<std::uint32_t> read_time(const ScipResponse& response);

}  // namespace adit

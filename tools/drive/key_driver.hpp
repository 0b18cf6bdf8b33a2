// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <optional>
#include <string_view>
#include <vector>

#include "common/types/vehicle.hpp"
#include "common/types/vehicle_state.hpp"

namespace adit {

enum class DriveKey { kFaster, kSlower, kLeft, kRight, kStop, kQuit };

/// Makes keys of what a terminal sends: arrows (which come as several bytes, perhaps not all at
/// once), w a s d, space, q. Everything else is let through.
class KeyReader {
 public:
  std::vector<DriveKey> read(std::string_view bytes);

 private:
  std::optional<DriveKey> read_one(char byte);

  int escape_ = 0;  // bytes of an escape sequence so far
};

/// What keys ask of the vehicle: each press changes speed or curvature by a step, and they stay so,
/// because a terminal does not tell when a key is released.
class KeyDriver {
 public:
  explicit KeyDriver(const Vehicle& vehicle) : vehicle_(vehicle) {}

  void press(DriveKey key);
  [[nodiscard]] DriveCommand command(std::int64_t utime) const;
  [[nodiscard]] bool quits() const { return quits_; }

 private:
  Vehicle vehicle_;
  int speed_steps_ = 0;      // of kSteps to the greatest speed
  int curvature_steps_ = 0;  // of kSteps to the tightest turn, positive to the left
  bool quits_ = false;
};

}  // namespace adit

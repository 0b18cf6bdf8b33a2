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

/// Decodes keys from the bytes of a terminal: arrows (several bytes, which may arrive separately),
/// w a s d, space, q. Other bytes are ignored.
class KeyReader {
 public:
  std::vector<DriveKey> read(std::string_view bytes);

 private:
  std::optional<DriveKey> read_one(char byte);

  int escape_ = 0;  // bytes of an escape sequence so far
};

/// Converts keys to commands: each press changes speed or curvature by one step, which then
/// persists, since a terminal does not report the release of keys.
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

// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>

namespace adit {

/// What a person orders a mission to do.
struct MissionOrder {
  enum class Kind : std::int8_t {
    kPause = 0,     ///< stand, until told to go on
    kGoOn = 1,      ///< after a pause
    kComeHome = 2,  ///< turn around for good
    kStop = 3,      ///< stand, and end the mission where it is
  };

  std::int64_t utime = 0;  ///< [µs since the epoch]
  Kind kind = Kind::kPause;

  friend bool operator==(const MissionOrder&, const MissionOrder&) = default;
};

}  // namespace adit

// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <string>

#include "adit/heartbeat_t.hpp"

#include "common/messages/result.hpp"

namespace adit {

/// How a stage is.
struct Health {
  enum class Level : std::int8_t {
    kOk = heartbeat_t::HEALTH_OK,
    kDegraded = heartbeat_t::HEALTH_DEGRADED,
    kFault = heartbeat_t::HEALTH_FAULT,
  };
  Level level = Level::kOk;
  std::string reason;  ///< one line, empty when OK

  friend bool operator==(const Health&, const Health&) = default;
};

/// A stage is alive, as it goes onto channel HEARTBEAT. Counts are since the start.
struct Heartbeat {
  std::int64_t utime = 0;  ///< bus time [µs since the epoch]
  std::string stage;
  Health health;
  std::int64_t handled = 0;
  std::int64_t refused = 0;
  std::int64_t dropped = 0;

  friend bool operator==(const Heartbeat&, const Heartbeat&) = default;
};

heartbeat_t to_message(const Heartbeat& heartbeat);

/// Refused: an implausible time, no stage, an unknown health.
Result<Heartbeat> from_message(const heartbeat_t& message);

}  // namespace adit

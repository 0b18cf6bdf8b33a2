// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "adit/config_t.hpp"
#include "adit/heartbeat_t.hpp"
#include "adit/stage_stats_t.hpp"

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
  std::int64_t rejected = 0;
  std::int64_t dropped = 0;

  friend bool operator==(const Heartbeat&, const Heartbeat&) = default;
};

heartbeat_t to_message(const Heartbeat& heartbeat);

/// Refused: an implausible time, no stage, an unknown health.
Result<Heartbeat> from_message(const heartbeat_t& message);

/// The configuration in effect, as it goes onto channel CONFIG.
struct ConfigSnapshot {
  std::int64_t utime = 0;  ///< bus time [µs since the epoch]
  std::string stage;
  std::string version;
  std::string yaml;

  friend bool operator==(const ConfigSnapshot&, const ConfigSnapshot&) = default;
};

config_t to_message(const ConfigSnapshot& snapshot);

/// Refused: an implausible time, no stage.
Result<ConfigSnapshot> from_message(const config_t& message);

/// What a stage did in an interval of bus time, as it goes onto channel STAGE_STATS.
struct StageStats {
  struct Subscription {
    std::string channel;
    std::int64_t handled = 0;
    std::int64_t rejected = 0;
    std::int64_t dropped = 0;
    double handler_mean_ms = -1.0;  ///< −1 where not measured
    double handler_max_ms = -1.0;   ///< −1 where not measured

    friend bool operator==(const Subscription&, const Subscription&) = default;
  };

  std::int64_t utime = 0;  ///< bus time at the end of the interval [µs since the epoch]
  std::string stage;
  double interval_s = 0.0;
  std::vector<Subscription> subscriptions;

  friend bool operator==(const StageStats&, const StageStats&) = default;
};

stage_stats_t to_message(const StageStats& stats);

/// Refused: an implausible time, no stage, an interval that is not finite or is negative.
Result<StageStats> from_message(const stage_stats_t& message);

}  // namespace adit

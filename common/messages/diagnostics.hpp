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

/// Health of a stage.
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

/// Heartbeat of a stage on channel HEARTBEAT. Counts are totals since the start.
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

/// Rejects an implausible time, an empty stage, an unknown health.
Result<Heartbeat> from_message(const heartbeat_t& message);

/// The configuration in effect, on channel CONFIG.
struct ConfigSnapshot {
  std::int64_t utime = 0;  ///< bus time [µs since the epoch]
  std::string stage;
  std::string version;
  std::string yaml;

  friend bool operator==(const ConfigSnapshot&, const ConfigSnapshot&) = default;
};

config_t to_message(const ConfigSnapshot& snapshot);

/// Rejects an implausible time and an empty stage.
Result<ConfigSnapshot> from_message(const config_t& message);

/// Activity of a stage in an interval of bus time, on channel STAGE_STATS.
struct StageStats {
  struct Subscription {
    std::string channel;
    std::int64_t handled = 0;
    std::int64_t rejected = 0;
    std::int64_t dropped = 0;
    double handler_mean_ms = -1.0;  ///< −1: not measured
    double handler_max_ms = -1.0;   ///< −1: not measured

    friend bool operator==(const Subscription&, const Subscription&) = default;
  };

  std::int64_t utime = 0;  ///< bus time at the end of the interval [µs since the epoch]
  std::string stage;
  double interval_s = 0.0;
  std::vector<Subscription> subscriptions;

  friend bool operator==(const StageStats&, const StageStats&) = default;
};

stage_stats_t to_message(const StageStats& stats);

/// Rejects an implausible time, an empty stage, an interval that is negative or not finite.
Result<StageStats> from_message(const stage_stats_t& message);

}  // namespace adit

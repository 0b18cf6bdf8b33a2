// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "adit/stage_stats_t.hpp"

#include "common/messages/result.hpp"

namespace adit {

/// What a stage did in an interval of bus time, as it goes onto channel STAGE_STATS.
struct StageStats {
  struct Subscription {
    std::string channel;
    std::int64_t handled = 0;
    std::int64_t refused = 0;
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

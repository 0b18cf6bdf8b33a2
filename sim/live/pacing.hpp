// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace adit {

/// Pace of simulated time.
struct PacingParams {
  std::optional<double> factor;       ///< of real time; empty: as fast as possible
  std::vector<std::string> wait_for;  ///< stages that must keep up
  double ahead_max_s = 0.2;           ///< of the slowest of them, at least a period of SIM_TIME
  /// How long a stage with an injected fault (kill, suspend) is not waited for; empty: until it
  /// answers again.
  std::optional<double> outage_max_s = {};
};

/// Decides when the simulator may step: not before the scaled wall time of the step, and at most
/// ahead_max_s ahead of the time that the slowest of the stages in wait_for has handled. Delays are
/// not caught up. Independent of clocks: wall time is any monotonic time [µs].
class Pacing {
 public:
  static constexpr std::int64_t kStageTimeoutUs = 5'000'000;  ///< of wall time

  struct Decision {
    enum class Kind { kStep, kWaitForClock, kWaitForStages };
    Kind kind = Kind::kStep;
    std::int64_t wait_us = 0;  ///< of wall time, at most
  };

  explicit Pacing(const PacingParams& params);

  /// A stage has handled all messages until `utime`. Stages not in wait_for are ignored.
  void done(std::string_view stage, std::int64_t utime);

  /// A fault was injected into the stage at `utime`. It is not waited for until it answers for a
  /// later time or outage_max_s has passed, since it would block the simulator. Stages not in
  /// wait_for are ignored.
  void exclude(std::string_view stage, std::int64_t utime);

  /// Whether the step to `utime` may be taken.
  Decision decide(std::int64_t utime, std::int64_t wall_us);

  /// Stages that have blocked the simulator for kStageTimeoutUs; each is returned once until it
  /// answers.
  std::vector<std::string> newly_timed_out(std::int64_t wall_us);

 private:
  struct Stage {
    std::optional<std::int64_t> done_utime;
    std::optional<std::int64_t> blocks_since_us;  // wall time
    bool reported = false;
    std::optional<std::int64_t> excluded_utime;
  };
  struct Origin {
    std::int64_t utime;
    std::int64_t wall_us;
  };

  [[nodiscard]] bool keeps_up(const Stage& stage, std::int64_t utime) const;
  [[nodiscard]] bool must_wait_for_stages(std::int64_t utime, std::int64_t wall_us);
  [[nodiscard]] std::int64_t until_due_us(std::int64_t utime, std::int64_t wall_us);

  std::optional<double> factor_;
  std::int64_t ahead_max_us_;
  std::optional<std::int64_t> outage_max_us_;
  std::map<std::string, Stage, std::less<>> stages_;
  std::optional<Origin> origin_;  // origin of the scaled wall time
};

}  // namespace adit

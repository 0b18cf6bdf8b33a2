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

/// How fast simulated time goes.
struct PacingParams {
  std::optional<double> factor;       ///< of real time; nothing: as fast as it goes
  std::vector<std::string> wait_for;  ///< stages that must keep up
  double ahead_max_s = 0.2;           ///< of the slowest of them, at least a period of SIM_TIME
  /// How long one that was killed or suspended on purpose is done without; nothing: until it
  /// answers again.
  std::optional<double> outage_max_s = {};
};

/// Says when the simulator may take its next step: not before the wall clock, times the factor, has
/// come there, and never more than ahead_max_s ahead of what the slowest of the stages that are
/// waited for has handled. Time in which the simulator was late is not made up for. Knows no clock:
/// wall time is any time that goes on steadily [µs].
class Pacing {
 public:
  static constexpr std::int64_t kStageTimeoutUs = 5'000'000;  ///< of wall time

  struct Decision {
    enum class Kind { kStep, kWaitForClock, kWaitForStages };
    Kind kind = Kind::kStep;
    std::int64_t wait_us = 0;  ///< of wall time, at most
  };

  explicit Pacing(const PacingParams& params);

  /// A stage has handled all until `utime`. Stages that nobody waits for are let through.
  void done(std::string_view stage, std::int64_t utime);

  /// The stage was killed or suspended on purpose at `utime`, and would hold up the simulator for
  /// ever: it is waited for again when it answers for a later time, and after outage_max_s. Of a
  /// stage that nobody waits for, nothing changes.
  void exclude(std::string_view stage, std::int64_t utime);

  /// Whether the step may be taken that leads to `utime`.
  Decision decide(std::int64_t utime, std::int64_t wall_us);

  /// Stages that have held up the simulator for kStageTimeoutUs, each told once until it answers.
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
  std::optional<Origin> origin_;  // from which real time counts
};

}  // namespace adit

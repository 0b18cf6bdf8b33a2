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
};

/// Says when the simulator may take its next step: not before the wall clock, times the factor, has
/// come there, and never more than ahead_max_s ahead of what the slowest of the stages that are
/// waited for has handled. Time in which the simulator was late is not made up for. Knows no clock:
/// wall time is any time that goes on steadily [µs].
class Pacing {
 public:
  static constexpr std::int64_t kPatienceUs = 5'000'000;  ///< of wall time

  struct Decision {
    enum class Kind { kStep, kWaitForClock, kWaitForStages };
    Kind kind = Kind::kStep;
    std::int64_t wait_us = 0;  ///< of wall time, at most
  };

  explicit Pacing(const PacingParams& params);

  /// A stage has handled all until `utime`. Stages that nobody waits for are let through.
  void done(std::string_view stage, std::int64_t utime);

  /// Nobody waits for the stage any more, as for one that was killed or suspended on purpose: it
  /// would hold up the simulator for ever. Of a stage that nobody waits for, nothing changes.
  void give_up(std::string_view stage);

  /// Whether the step may be taken that leads to `utime`.
  Decision decide(std::int64_t utime, std::int64_t wall_us);

  /// Stages that have held up the simulator for kPatienceUs, each told once until it answers.
  std::vector<std::string> newly_silent(std::int64_t wall_us);

 private:
  struct Stage {
    std::optional<std::int64_t> done_utime;
    std::optional<std::int64_t> blocks_since_us;  // wall time
    bool told = false;
  };
  struct Origin {
    std::int64_t utime;
    std::int64_t wall_us;
  };

  [[nodiscard]] bool must_wait_for_stages(std::int64_t utime, std::int64_t wall_us);
  [[nodiscard]] std::int64_t until_due_us(std::int64_t utime, std::int64_t wall_us);

  std::optional<double> factor_;
  std::int64_t ahead_max_us_;
  std::map<std::string, Stage, std::less<>> stages_;
  std::optional<Origin> origin_;  // from which real time counts
};

}  // namespace adit

// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "sim/live/pacing.hpp"
#include "sim/live/world_choice.hpp"

namespace adit {

/// A run of the simulator on LCM.
struct LiveRunOptions {
  std::string program;  ///< that speaks on standard error
  PacingParams pacing{.factor = 1.0, .wait_for = {}};
  std::filesystem::path config;     ///< empty: defaults
  std::vector<std::string> faults;  ///< as parse_fault takes them, besides those in the config
  std::string lcm_url;
  std::filesystem::path record;  ///< everything on the bus; an LCM log; empty: not written
  std::optional<double> for_s;   ///< of simulated time; until it is stopped without
  std::optional<std::int64_t> start_utime;  ///< of simulated time; that of the clock without
  bool print_config = false;  ///< write the configuration in effect to standard output, and end
};

/// The name by which a simulator that records waits for itself, as for a stage.
inline constexpr const char* kRecordStage = "record";

/// Runs the simulator until SIGINT, SIGTERM or its time is up. A run that failed goes on, standing
/// still. One that records is never far ahead of its record, and hears the stages out at the end.
/// Throws for what cannot be run or written.
void run_live(const WorldChoice& world, const LiveRunOptions& options);

}  // namespace adit

namespace CLI {
class App;
}

namespace adit {

/// The options of a live run, for `adit-sim` and `adit sim`.
void add_live_run_options(CLI::App& app, LiveRunOptions& options);

/// What both say about worlds, time and faults at the end of their help.
extern const char* const kLiveRunFooter;

}  // namespace adit

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

namespace CLI {
class App;
}

namespace adit {

/// Options of a run of the simulator on LCM.
struct LiveRunOptions {
  std::string program;  ///< prefix of messages on standard error
  PacingParams pacing{.factor = 1.0, .wait_for = {}};
  std::filesystem::path config;     ///< empty: defaults
  std::vector<std::string> faults;  ///< for parse_fault(), in addition to those in the config
  std::string lcm_url;
  std::filesystem::path record;  ///< LCM log of all messages; empty: none
  bool compress = false;         ///< the log, with zstd
  std::optional<double> for_s;   ///< simulated duration; unlimited if empty
  std::optional<std::int64_t>
      start_utime;            ///< simulated time at the start; the system clock if empty
  bool print_config = false;  ///< write the configuration in effect to standard output and exit
};

/// Parses the value of --speed: a multiple of real time, or nothing for `max`. Throws
/// CLI::ValidationError.
std::optional<double> speed_factor(const std::string& text);

/// The options of a live run, for `adit-sim` and `adit sim`.
void add_live_run_options(CLI::App& app, LiveRunOptions& options);

/// Help text of both on worlds, time and faults.
extern const char* const kLiveRunFooter;

/// Runs the simulator until SIGINT, SIGTERM or the end of its duration. After a failure of the run
/// the vehicle stands and the simulation continues. A simulator that records waits for its
/// recorder, and at the end for outstanding messages of the stages. Throws for invalid options and
/// on write errors.
void run_live(const WorldChoice& world, const LiveRunOptions& options);

}  // namespace adit

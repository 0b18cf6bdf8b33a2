// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <string>
#include <string_view>

#include "common/process_list/process_list.hpp"

namespace adit {

/// Parses a process list in procman's grammar (python/src/procman/sheriff_config.py):
///   group "sensing" {
///     cmd "scan_matching" {
///       exec = "adit-scan_matching --config robot.yaml"; deputy = "robot";
///       auto_respawn = "true"; stop_signal = 15; stop_time_allowed = 3;
///       depends_on = "laser", "imu"; restart_limit = 5;
///       alive_channel = "POSE"; alive_rate_hz = 5; start_timeout_s = 4;
///       answer_channel = "POSE"; answers_to = "LASER_FRONT", "LASER_REAR"; answer_timeout_s = 5;
///       answers_late = "true";
///     }
///   }
///   script "go" { start group "sensing" wait "running" timeout_s 20; wait ms 500;
///                 wait cmd "mapping" status "running"; run_script "other"; }
/// `depends_on`, `restart_limit`, the last three lines of the command and `timeout_s` extend
/// procman's grammar. Older files have `host` for `deputy`; a number may be quoted, as procman
/// writes it. The list is validated: unique names, existing and acyclic dependencies and script
/// calls.
///
/// Throws ConfigError: `name:line:column: ` and the expected token, or `name: ` and the error in
/// the list.
ProcessList parse_process_list(std::string_view text, const std::string& name);

/// Reads and parses a file. Throws ConfigError as above, and if the file cannot be read.
ProcessList read_process_list(const std::filesystem::path& path);

}  // namespace adit

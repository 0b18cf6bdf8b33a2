// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <memory>

namespace CLI {
class App;
}

namespace adit {

/// The whole of the command line, `adit`, with all of its sub-commands.
std::unique_ptr<CLI::App> make_adit_app();

/// Runs it. Exit code 0, or 2 with one line on standard error: wrong use, or a file that cannot be
/// used; or what a command says of its own for an answer that is no.
int run_adit(int argc, const char* const* argv);

// What follows adds one sub-command each, and lives in a file of its own; those that talk to the
// supervisor share one.
void add_completion_command(CLI::App& adit);
void add_drive_command(CLI::App& adit);
void add_eval_command(CLI::App& adit);
void add_import_command(CLI::App& adit);
void add_map_command(CLI::App& adit);
void add_mission_command(CLI::App& adit);
void add_logs_command(CLI::App& adit);
void add_optimize_command(CLI::App& adit);
void add_order_command(CLI::App& adit);
void add_plan_command(CLI::App& adit);
void add_process_commands(CLI::App& adit);
void add_reload_command(CLI::App& adit);
void add_report_command(CLI::App& adit);
void add_sample_command(CLI::App& adit);
void add_scan_command(CLI::App& adit);
void add_sim_command(CLI::App& adit);
void add_spy_command(CLI::App& adit);
void add_volume_command(CLI::App& adit);

}  // namespace adit

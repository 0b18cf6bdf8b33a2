// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <memory>
#include <string>
#include <string_view>

namespace CLI {
class App;
}

namespace adit {

struct ReportOptions;
struct SurveyResult;

/// The command line `adit` with all of its sub-commands.
std::unique_ptr<CLI::App> make_adit_app();

/// Parses and runs the command line. Returns the exit code: 0 on success, 2 with one line on
/// standard error for invalid usage or an unusable file, or a code that the command defines.
int run_adit(int argc, const char* const* argv);

/// What the end of a command's --help shows, beside purpose and options.
struct CommandHelp {
  std::string details;     ///< outputs, formats, conventions
  std::string exit_codes;  ///< those beside 0 and 2, a line each, or empty
  std::string examples;    ///< a line each
};
void set_help(CLI::App& command, const CommandHelp& help);

/// Writes a mission report with a progress bar. Warnings go to standard error, the location of the
/// page and the outcome of the mission to standard output. Throws as write_report does.
void print_report(ReportOptions options);

/// Prints what was surveyed, warnings to standard error. `folder`: of the results.
void print_survey(const SurveyResult& result, const std::filesystem::path& folder);

/// Formats the answer of a supervisor to "ps" (one row per line, tab-separated columns) as a table
/// with a heading. The group column is omitted if it is empty.
std::string process_table_text(std::string_view rows);

/// Adds the option --key of commands that send orders: the file of a SealKey, or empty.
void add_key_option(CLI::App& command, std::string& key);

// Each function adds one sub-command (add_process_commands: start, stop, restart and ps;
// add_commission_commands: check-stop and check-motion).
void add_campaign_command(CLI::App& adit);
void add_check_command(CLI::App& adit);
void add_check_driver_command(CLI::App& adit);
void add_commission_commands(CLI::App& adit);
void add_completion_command(CLI::App& adit);
void add_doctor_command(CLI::App& adit);
void add_drive_command(CLI::App& adit);
void add_eval_command(CLI::App& adit);
void add_export_command(CLI::App& adit);
void add_import_command(CLI::App& adit);
void add_key_command(CLI::App& adit);
void add_logs_command(CLI::App& adit);
void add_map_command(CLI::App& adit);
void add_merge_command(CLI::App& adit);
void add_mission_command(CLI::App& adit);
void add_optimize_command(CLI::App& adit);
void add_order_command(CLI::App& adit);
void add_plan_command(CLI::App& adit);
void add_process_commands(CLI::App& adit);
void add_reload_command(CLI::App& adit);
void add_report_command(CLI::App& adit);
void add_sample_command(CLI::App& adit);
void add_scan_command(CLI::App& adit);
void add_search_command(CLI::App& adit);
void add_sim_command(CLI::App& adit);
void add_spy_command(CLI::App& adit);
void add_survey_command(CLI::App& adit);
void add_view_command(CLI::App& adit);
void add_volume_command(CLI::App& adit);

}  // namespace adit

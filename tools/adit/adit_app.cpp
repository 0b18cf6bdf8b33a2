// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "tools/adit/adit_app.hpp"

#include <exception>
#include <iostream>

#include <CLI/App.hpp>
#include <fmt/format.h>

#include "common/bus/node/version.hpp"
#include "common/command_line/command_line.hpp"
#include "common/files/file_utils.hpp"
#include "common/text/message_text.hpp"

namespace adit {
namespace {

constexpr int kExitUnusable = 2;

constexpr const char* kAppFooter =
    R"(adit COMMAND --help describes a command: inputs, outputs, exit codes, examples.

Quick start, without a robot and without a recording:
  adit sample mine.log --truth mine.tum
  adit map mine.log --out mine)";

}  // namespace

std::unique_ptr<CLI::App> make_adit_app() {
  auto app = make_command_line(
      "Mapping, planning and simulation for a robot that surveys abandoned mines.", "adit");
  app->set_version_flag("--version", fmt::format("adit {}", version()));
  app->require_subcommand(0, 1);
  app->get_formatter()->column_width(34);
  app->footer(kAppFooter);
  add_campaign_command(*app);
  add_check_command(*app);
  add_check_driver_command(*app);
  add_commission_commands(*app);
  add_completion_command(*app);
  add_doctor_command(*app);
  add_drive_command(*app);
  add_eval_command(*app);
  add_export_command(*app);
  add_import_command(*app);
  add_key_command(*app);
  add_logs_command(*app);
  add_map_command(*app);
  add_merge_command(*app);
  add_mission_command(*app);
  add_optimize_command(*app);
  add_order_command(*app);
  add_plan_command(*app);
  add_process_commands(*app);
  add_reload_command(*app);
  add_report_command(*app);
  add_sample_command(*app);
  add_scan_command(*app);
  add_search_command(*app);
  add_sim_command(*app);
  add_spy_command(*app);
  add_survey_command(*app);
  add_view_command(*app);
  add_volume_command(*app);
  return app;
}

void set_help(CLI::App& command, const CommandHelp& help) {
  command.footer(fmt::format(R"({}

Exit codes:
  0  success
{}{}  2  invalid usage or unusable input; one line on standard error states the reason

Examples:
{})",
                             help.details, help.exit_codes, help.exit_codes.empty() ? "" : "\n",
                             help.examples));
}

namespace {

int run_command(CLI::App& app, int argc, const char* const* argv) try {
  if (const auto exit_code = parse_command_line(app, argc, argv)) return *exit_code;
  if (!app.get_subcommands().empty()) return 0;
  std::cerr << app.help();
  return kExitUnusable;
} catch (const CLI::RuntimeError& error) {  // a command has printed the reason
  return error.get_exit_code();
}

}  // namespace

int run_adit(int argc, const char* const* argv) try {
  const auto app = make_adit_app();
  const int exit_code = run_command(*app, argc, argv);
  finish_standard_output();
  return exit_code;
} catch (const CLI::ParseError& error) {
  print_error("adit", fmt::format("{}; see adit --help", error.what()));
  return kExitUnusable;
} catch (const std::exception& error) {
  print_error("adit", error.what());
  return kExitUnusable;
}

}  // namespace adit

// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include <filesystem>
#include <iostream>
#include <memory>

#include <CLI/App.hpp>
#include <fmt/format.h>

#include "common/command_line/command_line.hpp"
#include "common/text/message_text.hpp"
#include "tools/adit/adit_app.hpp"
#include "tools/adit/progress_bar.hpp"
#include "tools/carmen/carmen_import.hpp"

namespace adit {
namespace {

struct ImportOptions {
  std::filesystem::path input;
  std::filesystem::path output;
};

constexpr const char* kCarmenDetails =
    R"(Scans are written to channel LASER_FRONT and wheel odometry to WHEEL_ODOMETRY, with their
timestamps. The laser pose of a line is not imported, because many public logs contain corrected poses.
Malformed lines are skipped and reported on standard error, by reason.)";

constexpr const char* kCarmenExamples =
    R"(  adit import carmen intel.log.gz intel.lcmlog
  adit spy intel.lcmlog                           inspect the messages)";

void print_result(const CarmenReport& report, const ImportOptions& options) {
  for (const std::string& message : report.messages()) {
    print_error("adit", fmt::format("{}: skipped {}", options.input.string(), message));
  }
  if (const std::string times = report.times.text(); !times.empty()) {
    print_error("adit", fmt::format("{}: {}", options.input.string(), times));
  }
  std::cout << fmt::format("{}: {} scans, {} odometry lines; {} of {} lines skipped\n",
                           options.output.string(), report.scans, report.odometry_lines,
                           report.rejected_lines(), report.lines);
}

void import_carmen_log(const ImportOptions& options) {
  CarmenReport report;
  {
    ProgressBar bar("importing");
    report = import_carmen(options.input, options.output, [&](double done) { bar.update(done); });
  }
  print_result(report, options);
}

}  // namespace

void add_import_command(CLI::App& adit) {
  CLI::App* import = add_command(adit, "import", "Convert a log of another format to an LCM log");
  import->require_subcommand(1);
  CLI::App* carmen = add_command(
      *import, "carmen", "Convert a CARMEN log (FLASER, ROBOTLASER1 and ODOM lines) to an LCM log");
  set_help(*carmen, {kCarmenDetails, "", kCarmenExamples});
  const auto options = std::make_shared<ImportOptions>();
  carmen->add_option("IN", options->input, "CARMEN log, plain or gzip")
      ->type_name("FILE")
      ->required();
  carmen->add_option("OUT", options->output, "LCM log to write")->type_name("FILE")->required();
  carmen->callback([options] { import_carmen_log(*options); });
}

}  // namespace adit

// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include <filesystem>
#include <iostream>
#include <memory>

#include <CLI/CLI.hpp>

#include "tools/adit/adit_app.hpp"
#include "tools/adit/progress_bar.hpp"
#include "tools/carmen/carmen_import.hpp"

namespace adit {
namespace {

struct ImportOptions {
  std::filesystem::path input;
  std::filesystem::path output;
};

constexpr const char* kCarmenFooter =
    R"(Scans go onto LASER_FRONT and wheel odometry onto WHEEL_ODOMETRY, with their own times. The poses
that a line gives for the laser are not imported: in many logs somebody has corrected them.

Examples:
  adit import carmen intel.log.gz intel.lcmlog
  adit spy intel.lcmlog                           look at what is in it)";

void report(const CarmenReport& found, const ImportOptions& options) {
  for (const std::string& message : found.sentences()) {
    std::cerr << "adit: " << options.input.string() << ": skipped " << message << "\n";
  }
  std::cout << options.output.string() << ": " << found.scans << " scans, " << found.odometry_lines
            << " odometry lines; " << found.rejected_lines() << " of " << found.lines
            << " lines skipped\n";
}

void import_carmen_log(const ImportOptions& options) {
  CarmenReport found;
  {
    ProgressBar bar("importing");
    found = import_carmen(options.input, options.output, [&](double done) { bar.update(done); });
  }
  report(found, options);
}

}  // namespace

void add_import_command(CLI::App& adit) {
  CLI::App* import = adit.add_subcommand("import", "Turn a log of another kind into an LCM log");
  import->require_subcommand(1);
  CLI::App* carmen = import->add_subcommand(
      "carmen", "Turn a CARMEN log (FLASER, ROBOTLASER1 and ODOM lines) into an LCM log");
  carmen->footer(kCarmenFooter);
  const auto options = std::make_shared<ImportOptions>();
  carmen->add_option("IN", options->input, "The CARMEN log, plain or gzip")
      ->type_name("FILE")
      ->required();
  carmen->add_option("OUT", options->output, "The LCM log to write")->type_name("FILE")->required();
  carmen->callback([options] { import_carmen_log(*options); });
}

}  // namespace adit

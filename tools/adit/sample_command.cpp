// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <limits>
#include <memory>
#include <stdexcept>

#include <CLI/CLI.hpp>

#include "tools/adit/commands.hpp"
#include "tools/adit/progress_bar.hpp"
#include "tools/eval/tum.hpp"
#include "tools/sample_mine/sample_log.hpp"

namespace adit {
namespace {

struct Options {
  std::filesystem::path output;
  std::filesystem::path truth;
  std::uint64_t seed = 1;
  double length_m = std::numeric_limits<double>::infinity();
  bool half_degree = false;
};

constexpr const char* kFooter =
    R"(The mine is made up: an adit, a ring of workings, a cross-cut through a room on pillars, dead ends.
The robot drives 450 m through it and closes two loops. Laser and wheels have errors like real ones.
The same seed gives the same bytes.

Examples:
  adit sample mine.log                                  as a CARMEN log
  adit sample mine.lcmlog --truth mine.tum --seed 7     as an LCM log, with the true path)";

void write_truth(const Trajectory& truth, const std::filesystem::path& path) {
  std::ofstream out(path);
  write_tum(out, truth);
  if (!out.flush()) throw std::runtime_error("cannot write " + path.string());
}

void write_sample(const Options& options) {
  const LaserModel laser = options.half_degree ? half_degree_laser() : LaserModel{};
  SampleRun run(options.seed, laser, options.length_m);
  {
    ProgressBar bar("sampling");
    write_sample_log(run, options.output, [&](double done) { bar.update(done); });
  }
  if (!options.truth.empty()) write_truth(run.truth(), options.truth);
  std::cout << options.output.string() << ": " << run.truth().size() << " scans over "
            << std::lround(path_length_m(run.truth())) << " m\n";
}

}  // namespace

void add_sample_command(CLI::App& adit) {
  CLI::App* sample =
      adit.add_subcommand("sample", "Write the log of a drive through a made-up mine");
  sample->footer(kFooter);
  const auto options = std::make_shared<Options>();
  sample->add_option("OUT", options->output, "The log to write: .lcmlog, or .log for CARMEN text")
      ->type_name("FILE")
      ->required();
  sample->add_option("--truth", options->truth, "Also write the true path, in the TUM format")
      ->type_name("FILE");
  sample->add_option("--seed", options->seed, "Another number gives another mine")
      ->type_name("N")
      ->capture_default_str();
  sample->add_option("--length-m", options->length_m, "Only this much of the way")
      ->type_name("METRES")
      ->check(CLI::PositiveNumber);
  sample->add_flag("--half-degree", options->half_degree, "361 beams for each scan, not 181");
  sample->callback([options] { write_sample(*options); });
}

}  // namespace adit

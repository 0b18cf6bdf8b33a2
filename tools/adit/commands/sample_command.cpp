// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include <cmath>
#include <filesystem>
#include <iostream>
#include <memory>
#include <optional>
#include <string>

#include <CLI/App.hpp>
#include <fmt/format.h>

#include "common/command_line/command_line.hpp"
#include "common/geometry/pose2.hpp"
#include "tools/adit/adit_app.hpp"
#include "tools/adit/progress_bar.hpp"
#include "tools/eval/trajectory.hpp"
#include "tools/sim/sample_run.hpp"

namespace adit {
namespace {

struct SampleOptions {
  std::filesystem::path output;
  std::filesystem::path truth;
  SampleParams run;
  std::optional<double> yaw_bias_deg_per_m;
  double bearing_error_percent = 0.0;
  bool half_degree = false;
};

constexpr const char* kSampleDetails =
    R"(Runs the simulator along the built-in drive of a world and writes one laser and the wheel odometry,
with their errors. The same options give the same bytes.

Outputs:
  OUT        LCM log (.lcmlog) or CARMEN text (.log)
  --truth    true path in the TUM format

Worlds:
  sample    an adit, a ring of tunnels, a cross-cut through a room and pillars, dead ends; the robot
            drives 450 m and closes two loops
  parallel  two similar tunnels, 12 m apart. After 800 m, the odometry error places the robot in the
            wrong tunnel until it reaches a corner. Scan matching alone does the same with
            --bearing-error-percent -2.5
  grid      a grid of tunnels, 320 m by 210 m; 10.8 km, with a scan every 0.1 m)";

constexpr const char* kSampleExamples =
    R"(  adit sample mine.log                                  a CARMEN log
  adit sample mine.lcmlog --truth mine.tum --seed 7     an LCM log and the true path
  adit sample far.lcmlog --world grid --length-m 2000   2 km in a large mine)";

SampleParams run_params(const SampleOptions& options) {
  SampleParams params = options.run;
  if (options.half_degree) params.beams = 361;
  params.bearing_scale = 1.0 + options.bearing_error_percent / 100.0;
  if (options.yaw_bias_deg_per_m) {
    params.turn_bias_rad_per_m = deg_to_rad(*options.yaw_bias_deg_per_m);
  }
  return params;
}

void write_sample(const SampleOptions& options) {
  SampleRun run(run_params(options));
  {
    ProgressBar bar("sampling");
    write_sample_log(run, options.output, [&](double done) { bar.update(done); });
  }
  if (!options.truth.empty()) write_tum(options.truth, run.truth());
  std::cout << fmt::format("{}: {} scans over {} m\n", options.output.string(), run.truth().size(),
                           std::lround(path_length_m(run.truth())));
}

}  // namespace

void add_sample_command(CLI::App& adit) {
  CLI::App* sample =
      add_command(adit, "sample", "Write the log of a drive through a synthetic mine");
  set_help(*sample, {kSampleDetails, "", kSampleExamples});
  const auto options = std::make_shared<SampleOptions>();
  sample->add_option("OUT", options->output, "Log to write: .lcmlog, or .log for CARMEN text")
      ->type_name("FILE")
      ->required();
  sample->add_option("--truth", options->truth, "True path to write, in the TUM format")
      ->type_name("FILE");
  sample->add_option("--seed", options->run.seed, "Seed of the mine and of the sensor noise")
      ->type_name("N")
      ->check(number_in(at_least(0.0)))
      ->capture_default_str();
  sample->add_option("--length-m", options->run.length_max_m, "End the drive after this distance")
      ->type_name("METRES")
      ->check(number_in(above(0.0)));
  sample->add_option("--world", options->run.world, "World to drive in: sample, parallel or grid")
      ->type_name("NAME")
      ->check(CLI::IsMember({"sample", "parallel", "grid"}))
      ->capture_default_str();
  sample
      ->add_option("--yaw-bias-deg-per-m", options->yaw_bias_deg_per_m,
                   "Heading drift of the odometry, instead of that of the world")
      ->type_name("DEG")
      ->check(number_in(within(-10.0, 10.0)));
  sample
      ->add_option("--bearing-error-percent", options->bearing_error_percent,
                   "Scale error of the laser bearings: true over reported, minus 1")
      ->type_name("PERCENT")
      ->check(number_in(within(-10.0, 10.0)))
      ->capture_default_str();
  sample->add_flag("--half-degree", options->half_degree, "361 beams per scan instead of 181");
  sample->callback([options] { write_sample(*options); });
}

}  // namespace adit

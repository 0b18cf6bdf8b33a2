// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include <filesystem>
#include <fstream>
#include <memory>
#include <stdexcept>

#include <CLI/CLI.hpp>

#include "sim/live/live_run.hpp"
#include "sim/live/sim_options.hpp"
#include "sim/world/build_world.hpp"
#include "sim/world/world_file.hpp"
#include "tools/adit/commands.hpp"
#include "tools/sim/truth_files.hpp"

namespace adit {
namespace {

struct Options {
  WorldChoice world;
  LiveRunOptions run;
  std::filesystem::path truth;
  std::filesystem::path describe;

  [[nodiscard]] bool only_writes() const { return !truth.empty() || !describe.empty(); }
};

constexpr const char* kExamples = R"(

Examples:
  adit sim bruceton                                        in real time; then, beside it
  adit-scan_matching --sim-time & adit drive --keys        and drive
  adit sim mathies --speed max --wait-for scan_matching    as fast as scan matching keeps up
  adit sim random --seed 7 --damage 0.8 --describe my.yaml
  adit sim my.yaml --truth my_truth                        centre lines, plan and obstacles as JSON)";

void write_description(const WorldDescription& description, const std::filesystem::path& path) {
  std::ofstream out(path);
  out << to_world_file(description);
  if (!out.flush()) throw std::runtime_error("cannot write " + path.string());
}

void write_files(const Options& options) {
  const WorldDescription description = describe(options.world);
  if (!options.describe.empty()) write_description(description, options.describe);
  if (options.truth.empty()) return;
  write_truth_files(build_world(description), options.truth);
}

}  // namespace

void add_sim_command(CLI::App& adit) {
  CLI::App* sim = adit.add_subcommand("sim", "A mine to drive in, on LCM; or what is true of it");
  sim->footer(std::string(kLiveRunFooter) + kExamples);
  const auto options = std::make_shared<Options>();
  options->run.program = "adit sim";
  add_world_options(*sim, options->world)->required();
  add_live_run_options(*sim, options->run);
  sim->add_option("--truth", options->truth,
                  "Write drifts.geojson, plan.geojson, obstacles.json, and end")
      ->type_name("DIR");
  sim->add_option("--describe", options->describe,
                  "Write the whole description as a world file, and end")
      ->type_name("FILE");
  sim->callback([options] {
    if (options->only_writes()) return write_files(*options);
    run_live(options->world, options->run);
  });
}

}  // namespace adit

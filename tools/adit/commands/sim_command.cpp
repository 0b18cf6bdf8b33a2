// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include <filesystem>
#include <iostream>
#include <memory>
#include <string>

#include <CLI/App.hpp>

#include "common/command_line/command_line.hpp"
#include "common/files/file_utils.hpp"
#include "common/text/message_text.hpp"
#include "sim/live/live_run.hpp"
#include "sim/view/view.hpp"
#include "sim/view/view_options.hpp"
#include "sim/world/build_world.hpp"
#include "sim/world/world_file.hpp"
#include "tools/adit/adit_app.hpp"
#include "tools/sim/sim_files.hpp"

namespace adit {
namespace {

struct SimOptions {
  WorldChoice world;
  LiveRunOptions run;
  std::filesystem::path view;
  ViewOptions view_options;
  std::filesystem::path truth;
  std::filesystem::path description;

  [[nodiscard]] bool writes_files_only() const {
    return !view.empty() || !truth.empty() || !description.empty();
  }
};

constexpr const char* kSimExamples =
    R"(  adit sim bruceton                                        in real time; in another terminal:
  adit-scan_matching --sim-time & adit drive --keyboard    drive by the keyboard
  adit sim mathies --speed max --wait-for scan_matching    as fast as scan matching allows
  adit sim mathies --config deploy/config/groundhog.yaml --record run.lcmlog
  adit sim random --seed 7 --damage 0.8 --describe my.yaml
  adit sim my.yaml --view my.png --truth my_truth          picture; centre lines, plan and obstacles as JSON
  adit sim mathies --view beam.png --camera 300,0,0        picture with a perspective from this pose)";

void write_files(const SimOptions& options) {
  const WorldDescription description = describe(options.world);
  if (!options.description.empty())
    write_text_file(to_world_file(description), options.description);
  if (options.view.empty() && options.truth.empty()) return;
  const Site site(build_world(description));
  if (!options.truth.empty()) {
    write_truth_files(site.world(), options.truth);
    for (const std::string& sentence : missing_truth(site.world())) {
      print_error("adit sim", sentence);
    }
  }
  if (!options.view.empty()) write_view(site, options.view, options.view_options);
}

}  // namespace

void add_sim_command(CLI::App& adit) {
  CLI::App* sim = add_command(
      adit, "sim",
      "Simulate a robot in a mine on LCM, or write pictures and ground truth of the mine");
  set_help(*sim, {kLiveRunFooter, "", kSimExamples});
  const auto options = std::make_shared<SimOptions>();
  options->run.program = "adit sim";
  add_world_options(*sim, options->world)->required();
  add_live_run_options(*sim, options->run);
  CLI::Option* view =
      sim->add_option("--view", options->view, "Draw plan, section and perspective view, and exit")
          ->type_name("PNG");
  sim->add_option_function<std::string>(
         "--camera",
         [options](const std::string& pose) { options->view_options.from = parse_view_pose(pose); },
         "Pose of the camera of --view; by default behind the start pose")
      ->type_name("X,Y,HEADING_DEG")
      ->needs(view);
  sim->add_option("--truth", options->truth,
                  "Write ground truth (tunnels.geojson, plan.geojson, obstacles.json), and exit")
      ->type_name("DIR");
  sim->add_option("--describe", options->description,
                  "Write the complete description as a world file, and exit")
      ->type_name("FILE");
  sim->callback([options] {
    if (options->writes_files_only()) return write_files(*options);
    run_live(options->world, options->run);
  });
}

}  // namespace adit

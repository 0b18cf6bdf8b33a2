// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <memory>
#include <string>
#include <vector>

#include <CLI/App.hpp>
#include <fmt/format.h>

#include "common/bus/node/stop_signal.hpp"
#include "common/command_line/command_line.hpp"
#include "common/config/config.hpp"
#include "tools/adit/adit_app.hpp"
#include "viewer/view/live_view.hpp"
#include "viewer/view/log_view.hpp"
#include "viewer/view/viewer_options.hpp"

namespace adit {
namespace {

constexpr const char* kViewDetails =
    R"(Serves the viewer at http://127.0.0.1:8765/: map, 3D, plots, time, processes. Without LOG it shows what is
on LCM as it happens; with LOG it plays the logs of one mission, which the page starts, stops, and moves in
time. Foxglove and Lichtblick show the same at ws://127.0.0.1:8765. Ends with Ctrl-C. Only this computer can
connect; from another one: ssh -L 8765:127.0.0.1:8765 ROBOT)";

constexpr const char* kViewExamples =
    R"(  adit view                       the robot on this network, live
  adit view run.lcmlog            play a log
  adit view run.lcmlog --port 0   on any free port)";

struct ViewCommand {
  std::vector<std::filesystem::path> logs;
  std::filesystem::path config;
  std::string lcm_url;
  int port = -1;
  ViewerOptions view;
};

void run(ViewCommand command) {
  ViewerOptions& view = command.view;
  view.parameters = load_viewer_parameters(command.config);
  if (command.port >= 0) view.parameters.port = command.port;
  const StopSignal stop;
  const auto print_address = [&](std::uint16_t port) {
    std::cout << browser_address(view.parameters.address, port) << "\n" << std::flush;
  };
  if (command.logs.empty()) return run_live_view(view, command.lcm_url, stop, print_address);
  if (view.title.empty()) view.title = command.logs.front().filename().string();
  run_log_view(view, command.logs, stop, print_address);
}

}  // namespace

void add_view_command(CLI::App& adit) {
  CLI::App* command =
      add_command(adit, "view", "Serve the viewer: the live robot, or a log that is played");
  set_help(*command, {kViewDetails, "", kViewExamples});
  const auto options = std::make_shared<ViewCommand>();
  command->add_option("LOG", options->logs, "LCM logs of one mission")->type_name("FILE");
  command->add_option("--config", options->config, "YAML file with a section viewer")
      ->type_name("FILE");
  command->add_option("--port", options->port, "Port, instead of 8765; 0: any that is free")
      ->type_name("N")
      ->check(number_in(within(0, 65535)));
  command
      ->add_option("--allow-origin", options->view.allowed_origins,
                   "Web page of others that may connect, e.g. https://app.foxglove.dev")
      ->type_name("URL")
      ->allow_extra_args(false);
  command->add_option("--lcm-url", options->lcm_url, "LCM network, instead of the default")
      ->type_name("URL");
  command->callback([options] { run(*options); });
}

}  // namespace adit

// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include <cstdint>
#include <filesystem>
#include <iostream>
#include <memory>
#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

#include <CLI/App.hpp>

#include "common/bus/node/stop_signal.hpp"
#include "common/command_line/command_line.hpp"
#include "common/seal/secret_text.hpp"
#include "procs/supervisor/control/control_client.hpp"
#include "procs/supervisor/control/control_socket.hpp"
#include "tools/adit/adit_app.hpp"
#include "tools/mission/mission_folder.hpp"
#include "tools/mission/private_network.hpp"
#include "viewer/server/viewer_server.hpp"
#include "viewer/view/live_view.hpp"
#include "viewer/view/log_view.hpp"
#include "viewer/view/viewer_options.hpp"

namespace adit {
namespace {

constexpr const char* kViewDetails =
    R"(Serves the viewer at http://127.0.0.1:8765/: map, 3D, plots, time, processes. Without LOG it shows what is
on LCM as it happens; with LOG it plays the logs of one mission, which the page starts, stops, and moves in
time. With --mission it shows the mission that runs in DIR, on its private network, and plays its logs once it
has ended. Foxglove and Lichtblick show the same at ws://127.0.0.1:8765. Ends with Ctrl-C. Only this computer
can connect; from another one: ssh -L 8765:127.0.0.1:8765 ROBOT

Without --orders the view is read-only. With it, whoever knows the token that is printed can send the orders of
adit order, and start, stop and restart the processes of the supervisor of this computer.)";

constexpr const char* kViewExamples =
    R"(  adit view                       the robot on this network, live
  adit view run.lcmlog            play a log
  adit view run.lcmlog --port 0   on any free port
  adit view --mission out         the mission of `adit mission mathies --out out`
  adit view --orders              with orders)";

struct ViewCommand {
  std::vector<std::filesystem::path> logs;
  std::filesystem::path mission;
  std::filesystem::path config;
  std::string lcm_url;
  int port = -1;
  bool orders = false;
  SealParams seal;
  std::filesystem::path supervisor = find_socket_path();
  ViewerOptions view;
};

/// Prints the token.
std::optional<ViewerOrders> orders_of(const ViewCommand& command) {
  if (!command.orders) return std::nullopt;
  ViewerOrders orders{.token = random_secret(), .seal = command.seal};
  orders.control_process = [socket = command.supervisor](const std::string& action,
                                                         const std::string& process) {
    try {
      request_from_supervisor(socket, {action, process});
      return std::string();
    } catch (const std::runtime_error& error) {
      return std::string(error.what());
    }
  };
  std::cout << "token of orders: " << orders.token << "\n";
  return orders;
}

void run(ViewCommand command) {
  ViewerOptions& view = command.view;
  view.parameters = load_viewer_parameters(command.config);
  if (command.port >= 0) view.parameters.port = command.port;
  const StopSignal stop;
  const auto print_address = [&](std::uint16_t port) {
    std::cout << browser_address(view.parameters.address, port) << "\n" << std::flush;
  };
  if (!command.mission.empty()) {
    view.title = std::filesystem::absolute(command.mission).filename().string();
    if (process_of_mission(command.mission)) {
      view.listening_socket =
          listen_on(view.parameters.address, static_cast<std::uint16_t>(view.parameters.port));
      enter_network_of_mission(command.mission);
      command.supervisor = MissionFolder(command.mission).socket();
    } else {
      command.logs = MissionFolder(command.mission).logs();
    }
  }
  if (command.logs.empty())
    return run_live_view(view, command.lcm_url, orders_of(command), stop, print_address);
  if (command.orders)
    throw std::runtime_error("--orders: a log that is played takes none, only a running mission");
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
  command->add_option("--mission", options->mission, "Output folder of an adit mission")
      ->type_name("DIR");
  command->add_flag("--orders", options->orders, "Take orders with the token that is printed");
  add_key_option(*command, options->seal.key);
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

// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include <cstdint>
#include <exception>
#include <iostream>
#include <optional>
#include <string>

#include <CLI/App.hpp>
#include <fmt/format.h>
#include <sys/resource.h>

#include "common/bus/node/stages.hpp"
#include "common/bus/node/stop_signal.hpp"
#include "common/bus/node/version.hpp"
#include "common/command_line/command_line.hpp"
#include "common/config/config.hpp"
#include "common/files/file_utils.hpp"
#include "common/service/service_manager.hpp"
#include "common/text/message_text.hpp"
#include "viewer/view/live_view.hpp"
#include "viewer/view/viewer_options.hpp"

namespace {

constexpr const char* kProgram = "adit-viewer";
constexpr int kExitUnusable = 2;

struct Options {
  std::string config;
  std::string lcm_url;
  std::string title;
  int port = -1;
  bool print_config = false;
};

void declare(CLI::App& app, Options& options) {
  app.add_option("--config", options.config, "YAML file with a section viewer")
      ->type_name("FILE")
      ->envname("ADIT_CONFIG");
  app.add_option("--lcm-url", options.lcm_url,
                 "LCM provider (default udpm://239.255.76.67:7667?ttl=0)")
      ->type_name("URL");
  app.add_option("--port", options.port, "Port, instead of that of the configuration; 0: any")
      ->type_name("N")
      ->check(adit::number_in(adit::within(0, 65535)));
  app.add_option("--title", options.title, "Title of the mission")->type_name("TEXT");
  app.add_flag("--print-config", options.print_config,
               "Print every parameter with the value in effect and exit");
  app.set_version_flag("--version", fmt::format("{} {}", kProgram, adit::version()));
}

/// The stages come first: whatever the viewer has to do can wait.
void lower_priority() {
  constexpr int kLowPriority = 10;
  setpriority(PRIO_PROCESS, 0, kLowPriority);  // optional: errors are ignored
}

void run(const Options& options) {
  adit::ViewerOptions view;
  view.parameters = adit::load_viewer_parameters(options.config);
  view.title = options.title;
  if (options.port >= 0) view.parameters.port = options.port;
  view.listening_socket = adit::ServiceManager::take_listening_socket();
  if (options.print_config) {
    std::cout << adit::to_yaml(view.parameters, adit::kViewerSection);
    return;
  }
  lower_priority();
  const adit::StopSignal stop;  // before LCM starts its thread
  adit::run_live_view(view, options.lcm_url, std::nullopt, stop, [&](std::uint16_t port) {
    std::cout << adit::browser_address(view.parameters.address, port) << "\n" << std::flush;
  });
}

}  // namespace

int main(int argc, char** argv) try {
  const auto app = adit::make_command_line(
      "Serves the live view of what is on LCM to browsers, Foxglove and Lichtblick.", kProgram);
  Options options;
  declare(*app, options);
  const auto exit_code = adit::parse_command_line(*app, argc, argv);
  if (!exit_code) run(options);
  adit::finish_standard_output();
  return exit_code.value_or(0);
} catch (const std::exception& error) {
  adit::print_error(kProgram, error.what());
  return kExitUnusable;
}

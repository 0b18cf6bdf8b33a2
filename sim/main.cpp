// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include <exception>
#include <iostream>

#include <CLI/App.hpp>
#include <fmt/format.h>

#include "common/bus/node/version.hpp"
#include "common/command_line/command_line.hpp"
#include "common/files/file_utils.hpp"
#include "common/text/message_text.hpp"
#include "sim/live/live_run.hpp"

namespace {

constexpr int kExitUnusable = 2;

}  // namespace

int main(int argc, char** argv) try {
  const auto app = adit::make_command_line(
      "Simulates the robot in a mine and publishes its sensor data on LCM until SIGINT or SIGTERM.",
      "adit-sim");
  adit::LiveRunOptions options;
  options.program = "adit-sim";
  adit::WorldChoice world;
  adit::add_world_options(*app, world)->required();
  adit::add_live_run_options(*app, options);
  app->footer(adit::kLiveRunFooter);
  app->set_version_flag("--version", fmt::format("adit-sim {}", adit::version()));
  const auto exit_code = adit::parse_command_line(*app, argc, argv);
  if (!exit_code) adit::run_live(world, options);
  adit::finish_standard_output();
  return exit_code.value_or(0);
} catch (const std::exception& error) {
  adit::print_error("adit-sim", error.what());
  return kExitUnusable;
}

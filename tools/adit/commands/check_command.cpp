// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <filesystem>
#include <iostream>
#include <memory>
#include <string>

#include <CLI/App.hpp>
#include <fmt/format.h>

#include "common/command_line/command_line.hpp"
#include "common/config/config_file.hpp"
#include "common/files/file_utils.hpp"
#include "common/text/message_text.hpp"
#include "tools/adit/adit_app.hpp"
#include "tools/check_robot/abilities.hpp"
#include "tools/check_robot/robot_check.hpp"
#include "tools/check_robot/robot_picture.hpp"

namespace adit {
namespace {

constexpr int kExitRelation = 1;

struct CheckOptions {
  std::filesystem::path config;
  std::filesystem::path picture;  ///< empty: none
};

constexpr const char* kCheckDetails =
    R"(Checks the description of a robot before it moves: loads the sections of all stages, and prints one line for each
relation between keys that must hold, with its arithmetic. A line that begins with BAD says what to correct. Then:
what the robot passes (width, height, step, slope), how it turns, within what distance it stops at its speeds, what
its lasers see and where it is blind. --picture draws it from above: compare it with the robot.

A config that passes can still be wrong by less than these relations notice: measure, and see docs/howto/your_robot.md.)";

constexpr const char* kCheckExamples =
    R"(  adit check /etc/adit/robot.yaml
  adit check deploy/config/skid_steered.yaml --picture robot.png)";

void run(const CheckOptions& options) {
  const std::filesystem::path path = find_installed_file(options.config, "config");
  const RobotConfig given = load_robot_config(ConfigFile::load(path));
  const CheckResults results = check_robot(given);
  const RobotConfig robot = with_usable_footprint(given);
  const std::string name = path.filename().string();
  if (!options.picture.empty()) write_robot_png(options.picture, message_line(name), robot);
  std::cout << text_of_robot(message_line(name), results) << "\n" << text_of_abilities(robot);
  if (!options.picture.empty())
    std::cout << fmt::format("wrote     {}\n", message_line(options.picture.string()));
  const bool bad =
      std::ranges::count(results, CheckResult::Verdict::kBad, &CheckResult::verdict) > 0;
  if (bad) throw CLI::RuntimeError(kExitRelation);
}

}  // namespace

void add_check_command(CLI::App& adit) {
  CLI::App* command =
      add_command(adit, "check", "Check the description of a robot, and say what it can do");
  set_help(*command, {kCheckDetails, "  1  a relation does not hold", kCheckExamples});
  const auto options = std::make_shared<CheckOptions>();
  command->add_option("CONFIG", options->config, "YAML file of the robot")->required();
  command->add_option("--picture", options->picture, "Draw the robot from above")->type_name("PNG");
  command->callback([options] { run(*options); });
}

}  // namespace adit

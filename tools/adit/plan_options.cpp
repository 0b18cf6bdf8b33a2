// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "tools/adit/plan_options.hpp"

#include <cmath>
#include <string>

#include <CLI/CLI.hpp>

#include "common/geometry/angle.hpp"
#include "tools/plan/number_list.hpp"

namespace adit {
namespace {

// Headings of the help.
constexpr const char* kGoalGroup = "Where to go, from the robot: x ahead, y to the left";
constexpr const char* kPointsGroup = "Of bare points, what their file does not say";
constexpr const char* kLogsGroup = "Of logs that hold several scans";

double radians(const std::string& option, const std::string& text) {
  return wrap_angle(deg_to_rad(parse_number_list(option, text, 1, 1)[0]));
}

/// Without a heading, the one from the robot to there.
void set_goal(GoalChoice& goal, const std::string& text) {
  const auto numbers = parse_number_list("--goal", text, 2, 3);
  goal.kind = PlanGoal::Kind::kTo;
  const double heading_rad =
      numbers.size() == 3 ? wrap_angle(deg_to_rad(numbers[2])) : std::atan2(numbers[1], numbers[0]);
  goal.T_level_goal = {numbers[0], numbers[1], heading_rad};
}

}  // namespace

void add_goal_options(CLI::App& command, GoalChoice& goal) {
  CLI::Option* to = command
                        .add_option_function<std::string>(
                            "--goal", [&goal](const std::string& text) { set_goal(goal, text); },
                            "To a place; without a heading, the one from here to there")
                        ->type_name("X,Y[,DEG]")
                        ->group(kGoalGroup);
  command
      .add_option_function<std::string>(
          "--along",
          [&goal](const std::string& text) { goal.T_level_goal.theta = radians("--along", text); },
          "As far as possible in a direction; without, straight ahead")
      ->type_name("DEG")
      ->excludes(to)
      ->group(kGoalGroup);
  command.add_option("--distance", goal.distance_m, "How far at most")
      ->type_name("M")
      ->check(CLI::PositiveNumber)
      ->capture_default_str()
      ->excludes(to)
      ->group(kGoalGroup);
}

void add_placement_options(CLI::App& command, CloudPlacement& placement) {
  command.add_option("--up", placement.up, "Axis of the file against gravity")
      ->type_name("AXIS")
      ->check(CLI::IsMember({"x", "y", "z", "-x", "-y", "-z"}))
      ->capture_default_str()
      ->group(kPointsGroup);
  command
      .add_option_function<std::string>(
          "--origin",
          [&placement](const std::string& text) {
            const auto p = parse_number_list("--origin", text, 3, 3);
            placement.p_file_laser = Eigen::Vector3d(p[0], p[1], p[2]);
          },
          "Where the laser was, in the frame of the file")
      ->type_name("X,Y,Z")
      ->group(kPointsGroup);
  command
      .add_option_function<std::string>(
          "--stand",
          [&placement](const std::string& text) {
            const auto p = parse_number_list("--stand", text, 2, 2);
            placement.p_plan_vehicle = Eigen::Vector2d(p[0], p[1]);
          },
          "Where the vehicle's middle is, in the plan of the upright cloud")
      ->type_name("X,Y")
      ->group(kPointsGroup);
  command
      .add_option_function<std::string>(
          "--heading",
          [&placement](const std::string& text) {
            placement.heading_rad = radians("--heading", text);
          },
          "Of the vehicle, in that plan")
      ->type_name("DEG")
      ->group(kPointsGroup);
  command
      .add_option_function<std::string>(
          "--ground",
          [&placement](const std::string& text) {
            placement.ground_m = parse_number_list("--ground", text, 1, 1)[0];
          },
          "Height of the ground there, along the upward axis")
      ->type_name("M")
      ->group(kPointsGroup);
  command.add_flag("--level", placement.level, "Turn the points until the ground near by is level")
      ->group(kPointsGroup);
}

void add_log_options(CLI::App& command, ScanChoice& choice, bool& list) {
  CLI::Option* number = command.add_option("--scan", choice.number, "The N-th scan, from 1")
                            ->type_name("N")
                            ->group(kLogsGroup);
  CLI::Option* id = command.add_option("--id", choice.id, "The scan of this id")
                        ->type_name("ID")
                        ->excludes(number)
                        ->group(kLogsGroup);
  command.add_flag("--all", choice.all, "Each of them, into a folder of its own")
      ->excludes(number)
      ->excludes(id)
      ->group(kLogsGroup);
  command.add_flag("--list", list, "Say which there are, and end")->group(kLogsGroup);
}

}  // namespace adit

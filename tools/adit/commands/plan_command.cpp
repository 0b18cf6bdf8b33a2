// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include <cmath>
#include <iostream>
#include <memory>
#include <string>

#include <CLI/CLI.hpp>

#include "common/geometry/pose2.hpp"
#include "tools/adit/adit_app.hpp"
#include "tools/plan/cloud_placement.hpp"
#include "tools/plan/number_list.hpp"
#include "tools/plan/plan_run.hpp"
#include "tools/plan/scan_input.hpp"
#include "tools/plan/scan_plan.hpp"

namespace CLI {
class App;
}

namespace adit {
namespace {

// The options of `adit plan` by what they are about. What they set must outlive the parsing.
void add_goal_options(CLI::App& command, GoalChoice& goal);
void add_placement_options(CLI::App& command, CloudPlacement& placement);
void add_log_options(CLI::App& command, ScanChoice& choice, bool& list);

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
  goal.kind = PlanGoal::Kind::kToPose;
  const double heading_rad =
      numbers.size() == 3 ? wrap_angle(deg_to_rad(numbers[2])) : std::atan2(numbers[1], numbers[0]);
  goal.T_level_goal = {numbers[0], numbers[1], heading_rad};
}

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

constexpr int kExitNoPath = 3;

constexpr const char* kPlanFooter =
    R"(The folder then holds
  sheet.png             all of the following on one sheet, and a view of the points
  plan.png              the terrain with the path, or how far one gets and what is in the way
  terrain.png           how hard the ground is to pass: bright is easy
  clearance.png         how high the roof is above it
  unknown.png           what is known of the ground, and why not
  c_space.png           where the vehicle can be, at 8 of its headings
  kernels.png           the shape of the vehicle with which these are made
  path.json             outcome, points, blocking cells, and how long each step took

The robot stands where the scan was made. A log knows where that is: its clouds (channel CLOUD) are used,
or else put together from its scan requests, laser scans, tilts and poses. Bare points do not know; what
is assumed of them:
  - metres, and gravity along an axis: z, or --up (-y is that of cameras); --level mends a tilt by the ground
  - all seen from one place: VIEWPOINT of a PCD file, or else the file's origin, or --origin
  - the vehicle's middle stands below that place, or at --stand, and looks along the first axis of the plan (x
    for z up), or to --heading; on the ground, of which the height there is looked for, or is --ground
  - beams that met nothing left no trace: water is taken for ground that nobody looked at

Exit code: 0 a path, 3 none (with --all: on one of the scans), 2 what cannot be used.

Examples:
  adit scan mathies --at 308,5.84,-4.4 --out beam.lcmlog   before a broken beam
  adit scan mathies --at 120,1.6,3.6 --out free.lcmlog
  adit plan beam.lcmlog --out beam
  adit plan room.ply --out room --up y --goal 4,1.5
  adit plan run.lcmlog --list
  adit plan run.lcmlog --out all --all --config my.yaml)";

}  // namespace

void add_plan_command(CLI::App& adit) {
  CLI::App* command = adit.add_subcommand(
      "plan", "Find a path over one 3D scan, and draw the terrain and how the path came about");
  command->footer(kPlanFooter);
  struct PlanOptions {
    PlanRunOptions run;
    bool list = false;
  };
  const auto options = std::make_shared<PlanOptions>();
  command->add_option("INPUT", options->run.input, "Points (PLY, PCD, XYZ), or an LCM log")
      ->type_name("FILE")
      ->required();
  command->add_option("--out", options->run.folder, "Where the results go; made if not there")
      ->type_name("DIR");
  command
      ->add_option("--config", options->run.config,
                   "YAML file with sections terrain, planning, vehicle, ..")
      ->type_name("FILE");
  command
      ->add_option("--estimator", options->run.estimator,
                   "Of the height of the ground: paper takes extremes, kth leaves out strays")
      ->check(CLI::IsMember({"paper", "kth"}));
  add_goal_options(*command, options->run.goal);
  add_log_options(*command, options->run.choice, options->list);
  add_placement_options(*command, options->run.placement);
  command->callback([options] {
    if (options->list) return list_scans(options->run, std::cout, std::cerr);
    if (options->run.folder.empty()) throw CLI::RequiredError("--out");
    if (!run_plan(options->run, std::cout, std::cerr)) throw CLI::RuntimeError(kExitNoPath);
  });
}

}  // namespace adit

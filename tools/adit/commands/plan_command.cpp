// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <iostream>
#include <memory>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

#include <CLI/App.hpp>
#include <fmt/format.h>

#include "common/command_line/command_line.hpp"
#include "common/config/number_text.hpp"
#include "common/geometry/pose2.hpp"
#include "common/text/message_text.hpp"
#include "tools/adit/adit_app.hpp"
#include "tools/plan/cloud_placement.hpp"
#include "tools/plan/plan_run.hpp"
#include "tools/plan/scan_input.hpp"
#include "tools/plan/scan_plan.hpp"

namespace adit {
namespace {

// Headings of the help.
constexpr const char* kGoalGroup = "Goal, relative to the robot: x forward, y left";
constexpr const char* kPointsGroup = "Pose of sensor and vehicle, for point clouds";
constexpr const char* kLogsGroup = "Scan selection, for logs";

/// Parses comma-separated finite numbers such as "1.5,-2". Throws std::invalid_argument that names
/// the option if the text is malformed or has fewer than `min` or more than `max` numbers.
std::vector<double> parse_numbers(const std::string& option, const std::string& text,
                                  std::size_t min, std::size_t max) {
  std::vector<double> numbers;
  for (std::size_t from = 0; from <= text.size();) {
    const std::size_t to = std::min(text.find(',', from), text.size());
    const auto number = option_number(std::string_view(text).substr(from, to - from));
    if (!number) {
      throw std::invalid_argument(
          fmt::format("{}: {} is not a list of comma-separated numbers", option, quote(text)));
    }
    numbers.push_back(*number);
    from = to + 1;
  }
  if (numbers.size() < min || numbers.size() > max) {
    throw std::invalid_argument(fmt::format("{}: {} must have {}{} numbers", option, quote(text),
                                            min, max > min ? fmt::format(" or {}", max) : ""));
  }
  return numbers;
}

double parse_radians(const std::string& option, const std::string& text) {
  return wrap_angle(deg_to_rad(parse_numbers(option, text, 1, 1)[0]));
}

/// Without a heading, the heading is the direction from the robot to the goal.
void set_goal(GoalChoice& goal, const std::string& text) {
  const auto numbers = parse_numbers("--goal", text, 2, 3);
  goal.kind = PlanGoal::Kind::kToPose;
  const double heading_rad =
      numbers.size() == 3 ? wrap_angle(deg_to_rad(numbers[2])) : std::atan2(numbers[1], numbers[0]);
  goal.T_level_goal = {numbers[0], numbers[1], heading_rad};
}

void add_goal_options(CLI::App& command, GoalChoice& goal) {
  CLI::Option* pose = command
                          .add_option_function<std::string>(
                              "--goal", [&goal](const std::string& text) { set_goal(goal, text); },
                              "Goal pose; the default heading is the direction to the goal")
                          ->type_name("X,Y[,DEG]")
                          ->group(kGoalGroup);
  command
      .add_option_function<std::string>(
          "--direction-deg",
          [&goal](const std::string& text) {
            goal.T_level_goal.theta = parse_radians("--direction-deg", text);
          },
          "Plan as far as possible in this direction; by default straight ahead")
      ->type_name("DEG")
      ->excludes(pose)
      ->group(kGoalGroup);
  command.add_option("--distance-m", goal.distance_m, "Maximum distance in the direction")
      ->type_name("M")
      ->check(number_in(above(0.0)))
      ->capture_default_str()
      ->excludes(pose)
      ->group(kGoalGroup);
}

void add_placement_options(CLI::App& command, CloudPlacement& placement) {
  command.add_option("--up", placement.up, "Axis of the file that points up")
      ->type_name("AXIS")
      ->check(CLI::IsMember({"x", "y", "z", "-x", "-y", "-z"}))
      ->capture_default_str()
      ->group(kPointsGroup);
  command
      .add_option_function<std::string>(
          "--laser-at",
          [&placement](const std::string& text) {
            const auto p = parse_numbers("--laser-at", text, 3, 3);
            placement.p_file_laser = Eigen::Vector3d(p[0], p[1], p[2]);
          },
          "Position of the laser in the frame of the file [m]")
      ->type_name("X,Y,Z")
      ->group(kPointsGroup);
  command
      .add_option_function<std::string>(
          "--vehicle-at",
          [&placement](const std::string& text) {
            const auto p = parse_numbers("--vehicle-at", text, 2, 2);
            placement.p_plan_vehicle = Eigen::Vector2d(p[0], p[1]);
          },
          "Position of the vehicle centre in the horizontal plane of the upright cloud [m]")
      ->type_name("X,Y")
      ->group(kPointsGroup);
  command
      .add_option_function<std::string>(
          "--heading-deg",
          [&placement](const std::string& text) {
            placement.heading_rad = parse_radians("--heading-deg", text);
          },
          "Heading of the vehicle in this plane")
      ->type_name("DEG")
      ->group(kPointsGroup);
  command
      .add_option_function<std::string>(
          "--ground-m",
          [&placement](const std::string& text) {
            placement.ground_m = parse_numbers("--ground-m", text, 1, 1)[0];
          },
          "Ground height at the vehicle along the up axis; by default estimated")
      ->type_name("M")
      ->group(kPointsGroup);
  command.add_flag("--level", placement.level, "Rotate the cloud until the ground nearby is level")
      ->group(kPointsGroup);
}

void add_log_options(CLI::App& command, ScanChoice& choice, bool& logged, bool& list) {
  CLI::Option* number = command.add_option("--scan", choice.number, "N-th scan of the log, from 1")
                            ->type_name("N")
                            ->check(number_in(at_least(1.0)))
                            ->group(kLogsGroup);
  CLI::Option* id = command.add_option("--id", choice.id, "Scan with this id")
                        ->type_name("ID")
                        ->check(number_in())
                        ->excludes(number)
                        ->group(kLogsGroup);
  command.add_flag("--all", choice.all, "All scans, each into a sub-folder of DIR")
      ->excludes(number)
      ->excludes(id)
      ->group(kLogsGroup);
  command
      .add_flag("--logged", logged,
                "Plan again for the goal --id of the mission, with its terrain and parameters")
      ->needs(id)
      ->group(kLogsGroup);
  command.add_flag("--list", list, "List the scans and exit")->group(kLogsGroup);
}

constexpr int kExitNoPath = 3;

constexpr const char* kPlanDetails =
    R"(Builds the terrain of one 3D scan, its C-space, and a path, and draws each step.

Outputs in DIR:
  sheet.png             all pictures on one sheet, with a view of the points
  plan.png              terrain with the path, or the distance reached and the blocking cells
  terrain.png           traversability of the ground: bright is easy
  clearance.png         height of the roof above the ground
  unknown.png           observation state of the ground: measured, or why not
  c_space.png           C-space of the vehicle at 8 of its headings
  kernels.png           shapes of the vehicle that the C-space is computed with
  path.json             outcome, path points, blocking cells, computation times

The path starts at the pose of the scan. A log provides this pose: the command uses its clouds (channel
CLOUD), or assembles them from scan requests, laser scans, tilts and poses. For a point cloud (PLY, PCD, XYZ)
it assumes:
  - units of metres; z up, or --up (-y for camera frames); --level corrects a tilt by the ground
  - one viewpoint: VIEWPOINT of a PCD file, else the origin of the file, or --laser-at
  - the vehicle centre below the viewpoint, or --vehicle-at; heading along the first axis of the plane (x for
    z up), or --heading-deg; on the ground, whose height is estimated, or --ground-m
  - no data about beams without return: water appears as ground that was not scanned

The plan of a mission may rest on more than one scan: --logged takes the terrain map, the goal and the pose that
planning had, and says whether the outcome is that of the mission.)";

constexpr const char* kPlanExitCodes =
    "  3  no path; with --all, no path on at least one of the scans";

constexpr const char* kPlanExamples =
    R"(  adit scan mathies --at 308,5.84,-4.4 --out beam.lcmlog   in front of a broken beam
  adit plan beam.lcmlog --out beam
  adit plan room.ply --out room --up y --goal 4,1.5
  adit plan run.lcmlog --list
  adit plan run.lcmlog --out goal_80 --id 80 --logged    why did the mission find no path to goal 80?
  adit plan run.lcmlog --out all --all --config my.yaml)";

}  // namespace

void add_plan_command(CLI::App& adit) {
  CLI::App* command =
      add_command(adit, "plan", "Plan a path on one 3D scan, and draw terrain, C-space and path");
  set_help(*command, {kPlanDetails, kPlanExitCodes, kPlanExamples});
  struct PlanOptions {
    PlanRunOptions run;
    bool list = false;
  };
  const auto options = std::make_shared<PlanOptions>();
  command->add_option("INPUT", options->run.input, "Point cloud (PLY, PCD, XYZ) or LCM log")
      ->type_name("FILE")
      ->required();
  command->add_option("--out", options->run.folder, "Output folder; created if it does not exist")
      ->type_name("DIR");
  command
      ->add_option("--config", options->run.config,
                   "YAML file with sections terrain, planning, vehicle, ..")
      ->type_name("FILE");
  command
      ->add_option("--estimator", options->run.estimator,
                   "Ground height per cell: paper uses extremes, kth a rank, robust to outliers")
      ->check(CLI::IsMember({"paper", "kth"}));
  add_goal_options(*command, options->run.goal);
  add_log_options(*command, options->run.choice, options->run.logged, options->list);
  add_placement_options(*command, options->run.placement);
  command->callback([options] {
    if (options->list) return list_scans(options->run, std::cout, std::cerr);
    if (options->run.folder.empty()) throw CLI::RequiredError("--out");
    if (!run_plan(options->run, std::cout, std::cerr)) throw CLI::RuntimeError(kExitNoPath);
  });
}

}  // namespace adit

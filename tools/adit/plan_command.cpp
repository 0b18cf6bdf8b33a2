// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include <iostream>
#include <memory>
#include <string>

#include <CLI/CLI.hpp>

#include "tools/adit/commands.hpp"
#include "tools/adit/plan_options.hpp"
#include "tools/plan/plan_run.hpp"

namespace adit {
namespace {

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

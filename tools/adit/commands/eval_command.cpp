// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "tools/adit/commands/eval_command.hpp"

#include <filesystem>
#include <iostream>
#include <memory>
#include <optional>
#include <stdexcept>
#include <string>

#include <CLI/CLI.hpp>

#include "sim/world/build_world.hpp"
#include "sim/world/world_file.hpp"
#include "tools/adit/adit_app.hpp"
#include "tools/eval/map_image.hpp"
#include "tools/eval/map_score.hpp"
#include "tools/eval/relations.hpp"
#include "tools/eval/trajectory_score.hpp"
#include "tools/eval/tum.hpp"

namespace adit {
namespace {

struct EvalMapOptions {
  std::filesystem::path folder;
  std::string world;
  std::optional<int> seed;
  std::filesystem::path truth;
  MapScoreOptions score;
};

constexpr const char* kEvalMapFooter =
    R"(DIR is what `adit map DIR` has written: trajectory.tum, map.pgm with map.yaml, and run.lcmlog, in
which the simulator's truth is on channel TRUTH. The world must be the one that was driven in, and so
must the seed. The figures come as JSON:

trajectory  over the times that the truth covers
  aligned         distances from the true positions after the rigid motion that makes them least:
                  the absolute trajectory error of Sturm et al., IROS 2012
  anchored        the same with the first poses laid upon each other: what a robot without truth has
  relative        mean error of the motion over 1, 10 and 100 m of the way (Geiger et al., CVPR 2012);
                  no figures where the way is shorter
  length_ratio    length of the path over that of the true one, in steps of 0.5 m: below 1 it shrinks
map  its occupied cells, moved into the world by the same rigid motion; definitions of DARPA's
     map_analysis for the Subterranean Challenge, in the plan
  coverage          share of the walls that could be seen from the true way, to 10 m, that have a cell
                    within the tolerance
  coverage_of_mine  the same for the outlines of the whole mine, driven or not; null where unknown
  deviation         share of the cells that are far from any wall, post or rubble of the world between
                    0.1 and 2 m above its floor
  wall_distance     from the cells to the nearest of these: mean, median, 95th percentile

Examples:
  adit map run.lcmlog --out mine && adit eval map mine --world bruceton
  adit eval map mine --world random --seed 7 --truth truth.tum)";

/// That of the folder unless another is named.
Trajectory true_trajectory(const EvalMapOptions& options) {
  if (options.truth.empty()) return read_ground_truth(options.folder / "run.lcmlog");
  return read_tum(options.truth);
}

void print_score(const EvalMapOptions& options) {
  const Trajectory trajectory = read_tum(options.folder / "trajectory.tum");
  const std::vector<Eigen::Vector2d> mapped = read_occupied_cells(options.folder / "map.yaml");
  const Trajectory truth = true_trajectory(options);
  const TrajectoryScore score = score_trajectory(trajectory, truth);
  const Site site(build_world(find_world(options.world, options.seed)));
  const MapScore map = score_map(mapped, score.T_world_map, site, truth, options.score);
  std::cout << to_json(score, map) << "\n";
}

}  // namespace

void add_eval_map_command(CLI::App& eval) {
  CLI::App* map =
      eval.add_subcommand("map", "Score a trajectory and a map against a simulated world");
  map->footer(kEvalMapFooter);
  const auto options = std::make_shared<EvalMapOptions>();
  map->add_option("DIR", options->folder, "Folder of a run of `adit map`")
      ->type_name("DIR")
      ->required();
  map->add_option("--world", options->world, "Name of a world, or a world file or mesh")
      ->type_name("WORLD")
      ->required();
  map->add_option("--seed", options->seed, "Of the world, instead of its own")->type_name("N");
  map->add_option("--truth", options->truth, "True poses in the TUM format, instead of the log's")
      ->type_name("FILE");
  map->add_option("--tolerance-m", options->score.tolerance_m,
                  "To a cell, for a wall that counts as covered")
      ->check(CLI::PositiveNumber)
      ->capture_default_str();
  map->add_option("--deviation-m", options->score.deviation_m,
                  "To a wall, beyond which a cell is wrong")
      ->check(CLI::PositiveNumber)
      ->capture_default_str();
  map->callback([options] { print_score(*options); });
}

namespace {

struct EvalRelationsOptions {
  std::filesystem::path relations;
  std::filesystem::path trajectory;
};

constexpr const char* kRelationsFooter =
    R"(The metric of Kümmerle et al., "On measuring the accuracy of SLAM algorithms", Autonomous Robots
2009: each relation compares the motion between two times with the true one, so that an early error
is not counted again and again. The figures come as JSON: mean, standard deviation, median and
maximum of the translational error in metres and of the rotational error in degrees.

Example:
  adit eval relations intel.relations out/trajectory.tum)";

void print_score(const EvalRelationsOptions& options) {
  const auto relations = read_relations(options.relations);
  const RelationsScore score = score_relations(relations, read_tum(options.trajectory));
  if (score.used == 0) {
    throw std::runtime_error("no relation of " + options.relations.string() +
                             " lies within the time of " + options.trajectory.string());
  }
  std::cout << to_json(score) << "\n";
}

}  // namespace

void add_eval_relations_command(CLI::App& eval) {
  CLI::App* relations =
      eval.add_subcommand("relations", "Score a trajectory against hand-verified relations");
  relations->footer(kRelationsFooter);
  const auto options = std::make_shared<EvalRelationsOptions>();
  relations->add_option("RELATIONS", options->relations, "Lines `t1 t2 dx dy dz droll dpitch dyaw`")
      ->type_name("FILE")
      ->required();
  relations->add_option("TRAJECTORY", options->trajectory, "Poses in the TUM format")
      ->type_name("FILE")
      ->required();
  relations->callback([options] { print_score(*options); });
}

void add_eval_command(CLI::App& adit) {
  CLI::App* eval = adit.add_subcommand("eval", "Measure how good a trajectory or a map is");
  eval->require_subcommand(1);
  add_eval_map_command(*eval);
  add_eval_relations_command(*eval);
}

}  // namespace adit

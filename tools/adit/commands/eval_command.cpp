// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include <filesystem>
#include <iostream>
#include <memory>
#include <optional>
#include <stdexcept>
#include <string>

#include <CLI/App.hpp>
#include <fmt/format.h>

#include "common/bus/log/lcm_log.hpp"
#include "common/command_line/command_line.hpp"
#include "sim/world/build_world.hpp"
#include "sim/world/world_file.hpp"
#include "tools/adit/adit_app.hpp"
#include "tools/eval/map_image.hpp"
#include "tools/eval/map_score.hpp"
#include "tools/eval/relations.hpp"
#include "tools/eval/trajectory.hpp"
#include "tools/eval/trajectory_score.hpp"

namespace adit {
namespace {

struct EvalMapOptions {
  std::filesystem::path folder;
  std::string world;
  std::optional<int> seed;
  std::filesystem::path truth;
  MapScoreOptions score;
};

constexpr const char* kEvalMapDetails =
    R"(Inputs: the files trajectory.tum, map.pgm, map.yaml and run.lcmlog in the output folder of `adit map`.
The log provides the true poses of the simulator on channel TRUTH. World and seed must be those of the
simulation.

Output: JSON on standard output.

trajectory  over the time span of the true poses
  aligned         absolute trajectory error after least-squares alignment (Sturm et al., IROS 2012):
                  distances in plan, and the errors along x, y and z of the world; those of z are null for a
                  trajectory without heights
  anchored        the same with the first poses aligned instead
  relative        mean relative pose error over path lengths of 1, 10 and 100 m (Geiger et al., CVPR
                  2012); omitted where the path is shorter
  length_ratio    path length over true path length, in steps of 0.5 m; below 1 the map shrinks
map  its occupied cells after the same alignment, in 2D, with the definitions of DARPA's map_analysis for
     the Subterranean Challenge
  coverage          share of the walls visible from the true path within 10 m that have an occupied cell
                    within the tolerance
  coverage_of_mine  the same for the walls of the complete mine; null if unknown
  deviation         share of the occupied cells that are farther than --deviation-m from every wall, post
                    and rubble of the world between 0.1 and 2 m above the floor
  wall_distance     distance from the cells to the nearest of these: mean, median, 95th percentile)";

constexpr const char* kEvalMapExamples =
    R"(  adit map run.lcmlog --out mine && adit eval map mine --world bruceton
  adit eval map mine --world random --seed 7 --truth truth.tum)";

Trajectory true_trajectory(const EvalMapOptions& options) {
  if (options.truth.empty())
    return read_ground_truth(plain_or_compressed(options.folder / "run.lcmlog"));
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

void add_eval_map_command(CLI::App& eval) {
  CLI::App* map =
      add_command(eval, "map", "Score a trajectory and a map against a simulated world");
  set_help(*map, {kEvalMapDetails, "", kEvalMapExamples});
  const auto options = std::make_shared<EvalMapOptions>();
  map->add_option("DIR", options->folder, "Output folder of `adit map`")
      ->type_name("DIR")
      ->required();
  map->add_option("--world", options->world, "Built-in world, world file or mesh")
      ->type_name("WORLD")
      ->required();
  map->add_option("--seed", options->seed, "Seed of the world, instead of its default")
      ->type_name("N")
      ->check(number_in(at_least(0.0)));
  map->add_option("--truth", options->truth,
                  "True poses in the TUM format, instead of those in the log")
      ->type_name("FILE");
  map->add_option("--tolerance-m", options->score.tolerance_m,
                  "Maximum distance of a covered wall to an occupied cell [m]")
      ->check(number_in(above(0.0)))
      ->capture_default_str();
  map->add_option("--deviation-m", options->score.deviation_m,
                  "Distance to the nearest wall beyond which a cell is wrong [m]")
      ->check(number_in(above(0.0)))
      ->capture_default_str();
  map->callback([options] { print_score(*options); });
}

struct EvalRelationsOptions {
  std::filesystem::path relations;
  std::filesystem::path trajectory;
};

constexpr const char* kRelationsDetails =
    R"(Computes the metric of Kümmerle et al., "On measuring the accuracy of SLAM algorithms", Autonomous
Robots 2009. Each relation compares the estimated motion between two times with the true motion, so that
an early error counts once.

Output: JSON on standard output with mean, standard deviation, median and maximum of the translational
error [m] and of the rotational error [degrees].)";

constexpr const char* kRelationsExamples =
    "  adit eval relations intel.relations out/trajectory.tum";

void print_score(const EvalRelationsOptions& options) {
  const auto relations = read_relations(options.relations);
  const RelationsScore score = score_relations(relations, read_tum(options.trajectory));
  if (score.used == 0) {
    throw std::runtime_error(fmt::format("no relation of {} is within the time span of {}",
                                         options.relations.string(), options.trajectory.string()));
  }
  std::cout << to_json(score) << "\n";
}

void add_eval_relations_command(CLI::App& eval) {
  CLI::App* relations =
      add_command(eval, "relations", "Score a trajectory against hand-verified relations");
  set_help(*relations, {kRelationsDetails, "", kRelationsExamples});
  const auto options = std::make_shared<EvalRelationsOptions>();
  relations
      ->add_option("RELATIONS", options->relations, "Text lines `t1 t2 dx dy dz droll dpitch dyaw`")
      ->type_name("FILE")
      ->required();
  relations->add_option("TRAJECTORY", options->trajectory, "Poses in the TUM format")
      ->type_name("FILE")
      ->required();
  relations->callback([options] { print_score(*options); });
}

}  // namespace

void add_eval_command(CLI::App& adit) {
  CLI::App* eval = add_command(adit, "eval", "Measure the accuracy of a trajectory or a map");
  eval->require_subcommand(1);
  add_eval_map_command(*eval);
  add_eval_relations_command(*eval);
}

}  // namespace adit

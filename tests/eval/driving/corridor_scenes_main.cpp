// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
// corridor_scenes_table SCENES: plans a path over one 3D scan in each of SCENES random corridors of
// the simulator and drives it with the true vehicle in the true mesh. Prints a table in Markdown;
// the seeds of scenes with a fault or without a path go to the standard error.
#include <algorithm>
#include <atomic>
#include <cstdio>
#include <filesystem>
#include <map>
#include <stdexcept>
#include <string>
#include <thread>
#include <vector>

#include <CLI/CLI.hpp>

#include "procs/planning/planning_picture.hpp"
#include "tests/eval/markdown.hpp"
#include "tests/support/scores/corridor_run.hpp"
#include "tests/support/scores/path_feasibility.hpp"

namespace adit {
namespace {

constexpr double kPassableM = 8.0;  // length of tunnel that the vehicle must be able to drive

struct Options {
  int scenes = 200;
  int first = 0;
  int jobs = 1;
  double margin_m = 0.2;  ///< around the vehicle, lost by the cells and regions of the terrain
  std::string estimator = "kth";
  std::string kind;
  std::filesystem::path picture;
};

struct Scene {
  int seed = 0;
  std::string kind;
  PlannedPath path;
  std::optional<FeasibilityFault> fault;
  double along_m = 0.0;    ///< length of the path along the corridor
  double passage_m = 0.0;  ///< length that the true vehicle with the margin can drive
  double terrain_ms = 0.0;
  double plan_ms = 0.0;

  [[nodiscard]] bool found() const { return path.outcome == PlanOutcome::kFound; }
  [[nodiscard]] bool passable() const { return passage_m >= kPassableM; }
};

Scene evaluate_scene(int seed, const Options& options, Planning& planning) {
  const Corridor corridor = random_corridor_with_robot(seed);
  const CorridorRun run =
      run_corridor(corridor, options.estimator, static_cast<std::uint64_t>(seed), planning);
  const double passage_m =
      feasible_distance_m(corridor, inflated_vehicle(Vehicle{}, options.margin_m), kPassableM);
  return {seed,        corridor.kind, run.path,       run.fault,
          run.along_m, passage_m,     run.terrain_ms, run.plan_ms};
}

void draw(int seed, const Options& options) {
  Planning planning{PlanningParams{}};
  const Corridor corridor = random_corridor_with_robot(seed);
  const CorridorRun run =
      run_corridor(corridor, options.estimator, static_cast<std::uint64_t>(seed), planning);
  std::string title = std::to_string(seed) + ", " + corridor.kind + ": " + run.path.reason;
  if (run.fault) {
    const Pose2 at = between(run.terrain.T_odom_level, run.fault->T_world_body);
    char text[200];
    std::snprintf(text, sizeof text, " %s at %.2f, %.2f, %.2f rad", run.fault->what.c_str(), at.x,
                  at.y, at.theta);
    title += text;
  }
  std::printf("%s\n", title.c_str());
  write_plan_png(planning_picture(title, run.terrain, run.path, planning, Vehicle{}, {0.0}),
                 options.picture);
}

/// The fault of a scene, or an empty text.
std::string error_text(const Scene& scene) {
  char text[400] = "";
  if (scene.fault) {
    std::snprintf(text, sizeof text, "%s after %.2f m", scene.fault->what.c_str(),
                  scene.fault->driven_m);
  } else if (scene.passable() && !scene.found()) {
    std::snprintf(text, sizeof text, "not solved: %s", scene.path.reason.c_str());
  }
  return text;
}

struct Counts {
  int scenes = 0, found = 0, faults = 0, passable = 0, solved = 0, blocked = 0, rejected = 0;
  double along_m = 0.0;

  void add(const Scene& scene) {
    ++scenes;
    found += scene.found();
    faults += scene.fault.has_value();
    passable += scene.passable();
    solved += scene.passable() && scene.found();
    if (scene.passable() && scene.found()) along_m += scene.along_m;
    blocked += scene.passage_m < 2.0;
    rejected += scene.passage_m < 2.0 && !scene.found();
  }
  void print(const std::string& name) const {
    std::printf("| %s | %d | %d | %d | %d | %d | %.1f | %d | %d |\n", name.c_str(), scenes, found,
                faults, passable, solved, along_m / std::max(solved, 1), blocked, rejected);
  }
};

void print_times(const char* name, std::vector<double> ms) {
  std::sort(ms.begin(), ms.end());
  const auto at = [&](double share) {
    return ms[static_cast<std::size_t>(share * static_cast<double>(ms.size() - 1))];
  };
  std::printf("%s: median %.1f, 95 %% %.1f, worst %.1f ms\n", name, at(0.5), at(0.95), at(1.0));
}

void print(const std::vector<Scene>& scenes) {
  std::map<std::string, Counts> kinds;
  Counts all;
  std::vector<double> terrain_ms;
  std::vector<double> plan_ms;
  std::vector<double> both_ms;
  for (const Scene& scene : scenes) {
    kinds[scene.kind].add(scene);
    all.add(scene);
    terrain_ms.push_back(scene.terrain_ms);
    plan_ms.push_back(scene.plan_ms);
    both_ms.push_back(scene.terrain_ms + scene.plan_ms);
    const std::string error = error_text(scene);
    if (error.empty()) continue;
    std::fprintf(stderr, "seed %d, %s, passage %.1f m, path %.1f m: %s\n", scene.seed,
                 scene.kind.c_str(), scene.passage_m, scene.along_m, error.c_str());
  }
  print_heading(
      "| corridor | scenes | paths | faults | passable | solved | path length (m) | blocked "
      "| rejected |");
  for (const auto& [name, counts] : kinds) counts.print(name);
  all.print("all");
  std::printf("\n");
  print_times("terrain", terrain_ms);
  print_times("plan", plan_ms);
  print_times("scan to path", both_ms);
}

std::vector<Scene> run(const Options& options) {
  const auto kinds = static_cast<int>(corridor_kinds().size());
  std::vector<int> seeds;
  for (int seed = options.first; static_cast<int>(seeds.size()) < options.scenes; ++seed) {
    const std::string& kind = corridor_kinds()[static_cast<std::size_t>(seed % kinds)];
    if (options.kind.empty() || options.kind == kind) seeds.push_back(seed);
  }
  std::vector<Scene> scenes(seeds.size());
  std::atomic<std::size_t> next = 0;
  const auto work = [&] {
    Planning planning{PlanningParams{}};
    for (std::size_t i = next++; i < seeds.size(); i = next++) {
      scenes[i] = evaluate_scene(seeds[i], options, planning);
    }
  };
  std::vector<std::thread> threads;
  for (int i = 0; i < options.jobs; ++i) threads.emplace_back(work);
  for (std::thread& thread : threads) thread.join();
  return scenes;
}

}  // namespace
}  // namespace adit

int main(int argc, char** argv) {
  adit::Options options;
  CLI::App app{"Plans over one 3D scan in random simulated corridors and drives the paths"};
  app.add_option("scenes", options.scenes, "Number of scenes")->check(CLI::Range(1, 100000));
  app.add_option("--first", options.first, "Seed of the first scene");
  app.add_option("--jobs", options.jobs, "Number of parallel threads")->check(CLI::Range(1, 64));
  app.add_option("--margin", options.margin_m,
                 "Margin around the vehicle in passable corridors [m]");
  app.add_option("--estimator", options.estimator, "Terrain estimator")
      ->check(CLI::IsMember({"kth", "paper"}));
  app.add_option("--kind", options.kind, "Only corridors of this kind")
      ->check(CLI::IsMember(adit::corridor_kinds()));
  app.add_option("--picture", options.picture, "Draws the first scene only, to this PNG file");
  CLI11_PARSE(app, argc, argv);
  try {
    if (options.picture.empty()) {
      adit::print(adit::run(options));
    } else {
      adit::draw(options.first, options);
    }
  } catch (const std::exception& error) {
    std::fprintf(stderr, "corridor_scenes_table: %s\n", error.what());
    return 2;
  }
  return 0;
}

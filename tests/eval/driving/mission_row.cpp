// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "tests/eval/driving/mission_row.hpp"

#include <algorithm>
#include <array>
#include <cstdlib>
#include <exception>
#include <fstream>
#include <iostream>
#include <map>

#include <nlohmann/json.hpp>
#include <sys/wait.h>
#include <unistd.h>

#include "sim/live/sim_config.hpp"
#include "sim/live/world_choice.hpp"
#include "sim/world/build_world.hpp"
#include "tests/eval/markdown.hpp"
#include "tests/support/scores/mission_log.hpp"
#include "tools/mission/mission_run.hpp"

namespace adit {
namespace test {

NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE(MissionScore, outcome, reason, distance_from_start_m, farthest_m,
                                   relief_m, corridor_m, covered_share, missed_m,
                                   certainly_missed_m, distance_travelled_m, simulated_s, wall_s,
                                   scans, rmse_m, rmse_xyz_m, plan_of_allowed, height_of_allowed,
                                   local_maps, in_interval, in_ellipsoid, normalised_error_squared,
                                   rmse_estimated_m, rmse_estimated_z_m, length_ratio, verdicts,
                                   false_verdicts, unconfirmed, route_home_verdicts, complete,
                                   rescans, back_offs, guard_stops, activity_times, activity_s,
                                   activity_m, loop_closures, between_levels, merged_m,
                                   loop_closure_error_m, wrong_loop_closures, least_clearance_m)

}  // namespace test

namespace {

std::filesystem::path folder_of(const MissionRow& row, const MissionRowOptions& options) {
  std::string name = std::filesystem::path(row.name).filename().string();  // of a world file
  std::replace(name.begin(), name.end(), ':', '_');
  return options.folder / name;
}

/// Runs a mission in the child process and writes its score to a file.
[[noreturn]] void run_child(const MissionRow& row, const MissionRowOptions& options) {
  int code = 0;
  try {
    const nlohmann::json score = run_row(row, options);
    std::ofstream(folder_of(row, options) / "score.json") << score.dump(2) << "\n";
  } catch (const std::exception& error) {
    std::cerr << row.name << ": " << error.what() << "\n";
    code = 2;
  }
  std::_Exit(code);
}

void read_score(int status, MissionRow& row, const MissionRowOptions& options) {
  if (WIFEXITED(status) && WEXITSTATUS(status) == 0) {
    std::ifstream file(folder_of(row, options) / "score.json");
    row.score = nlohmann::json::parse(file).get<test::MissionScore>();
  } else {
    row.score.outcome = "crashed";
    row.score.reason =
        WIFSIGNALED(status) ? "signal " + std::to_string(WTERMSIG(status)) : "see standard error";
  }
  std::cerr << row.name << ": " << row.score.outcome << ", " << row.score.reason << "\n";
}

/// "97, 95, 93; 94", in percent.
std::string coverage_text(const std::array<std::size_t, 3>& in_interval, std::size_t in_ellipsoid,
                          std::size_t local_maps) {
  if (local_maps == 0) return "–";
  const auto percent = [&](std::size_t n) {
    return 100.0 * static_cast<double>(n) / static_cast<double>(local_maps);
  };
  return format("%.0f, %.0f, %.0f; %.0f", percent(in_interval[0]), percent(in_interval[1]),
                percent(in_interval[2]), percent(in_ellipsoid));
}

struct MissionSums {
  int returned = 0, failed = 0, crashed = 0, returned_to_start = 0, verdicts = 0,
      false_verdicts = 0;
  int unconfirmed = 0, route_home_verdicts = 0, complete = 0, false_complete = 0,
      certainly_false_complete = 0, guard_stops = 0;
  std::size_t local_maps = 0, in_ellipsoid = 0, loop_closures = 0, between_levels = 0;
  std::size_t wrong_loop_closures = 0;
  std::array<std::size_t, 3> in_interval{};
  double plan_of_allowed = 0.0, height_of_allowed = 0.0, normalised_error_squared = 0.0;
  double covered_share = 0.0, distance_travelled_m = 0.0, simulated_s = 0.0, rmse_max_m = 0.0;
  double merged_m = 0.0;

  void add(const test::MissionScore& score) {
    returned += score.outcome == "home";
    const bool at_home = score.outcome == "home" || score.outcome == "home uncertain";
    returned_to_start += at_home && score.distance_from_start_m <= 0.5;
    failed += score.outcome == "failed";
    crashed += score.outcome == "crashed";
    verdicts += score.verdicts;
    false_verdicts += score.false_verdicts;
    unconfirmed += score.unconfirmed;
    route_home_verdicts += score.route_home_verdicts;
    complete += score.complete;
    false_complete += score.false_complete();
    certainly_false_complete += score.complete && score.certainly_missed_m > 2.0;
    guard_stops += score.guard_stops;
    local_maps += score.local_maps;
    in_ellipsoid += score.in_ellipsoid;
    for (std::size_t i = 0; i < 3; ++i) in_interval[i] += score.in_interval[i];
    normalised_error_squared +=
        static_cast<double>(score.local_maps) * score.normalised_error_squared;
    plan_of_allowed = std::max(plan_of_allowed, score.plan_of_allowed);
    height_of_allowed = std::max(height_of_allowed, score.height_of_allowed);
    loop_closures += score.loop_closures;
    between_levels += score.between_levels;
    wrong_loop_closures += score.wrong_loop_closures;
    merged_m += score.merged_m;
    covered_share += score.covered_share;
    distance_travelled_m += score.distance_travelled_m;
    simulated_s += score.simulated_s;
    rmse_max_m = std::max(rmse_max_m, score.rmse_m);
  }
};

}  // namespace

test::MissionScore run_row(const MissionRow& row, const MissionRowOptions& options) {
  MissionRunOptions run;
  run.world = row.world;
  run.folder = folder_of(row, options);
  run.config = options.config;
  run.time_max_s = options.time_max_s;
  std::filesystem::remove_all(run.folder);
  const MissionRunResult result = run_mission(run);
  const test::MissionLog log = test::read_mission(run.folder / "run.lcmlog");
  const Vehicle vehicle = load_simulation_params(options.config, {}).vehicle;
  test::MissionScore score =
      test::MissionTruth(build_world(describe(row.world, vehicle)), vehicle).score(log);
  score.wall_s = result.wall_s;
  if (!options.keep_log) std::filesystem::remove(run.folder / "run.lcmlog");
  return score;
}

void run_rows(std::vector<MissionRow>& rows, const MissionRowOptions& options, int jobs) {
  std::map<pid_t, MissionRow*> active;
  std::filesystem::create_directories(options.folder);
  const auto wait_for_one = [&] {
    int status = 0;
    const auto child = active.find(waitpid(-1, &status, 0));
    if (child == active.end()) return;
    read_score(status, *child->second, options);
    active.erase(child);
  };
  for (MissionRow& row : rows) {
    if (static_cast<int>(active.size()) >= jobs) wait_for_one();
    const pid_t pid = fork();
    if (pid == 0) run_child(row, options);
    if (pid > 0) active[pid] = &row;
  }
  while (!active.empty()) wait_for_one();
}

void print_table(const std::vector<MissionRow>& rows) {
  print_heading(
      "| mine | outcome | from the start (m) | farthest (m) | corridor (m) | seen (%) "
      "| missed; by the vehicle with margin (m) | path length (m) | simulated (s) | wall (s) "
      "| scans | RMSE, map (m); of allowed | RMSE of z, map (m); of allowed "
      "| x, y, z in 95 % interval (%); in ellipsoid (%) | RMSE, online (m) | length ratio | "
      "blocked | falsely blocked "
      "| unconfirmed | on the return route | complete | falsely complete | rescans | back-offs "
      "| guard stops | loop closures; between levels | merged (m) |");
  for (const auto& [name, world, score] : rows) {
    std::cout
        << format("| %s | %s | %.2f | %.0f | %.0f | %.1f | %.0f; %.0f | %.0f | %.0f | %.0f | %d ",
                  name.c_str(), score.outcome.c_str(), score.distance_from_start_m,
                  score.farthest_m, score.corridor_m, 100.0 * score.covered_share, score.missed_m,
                  score.certainly_missed_m, score.distance_travelled_m, score.simulated_s,
                  score.wall_s, score.scans)
        << format("| %.3f; %.1f | %.3f; %.1f | %s ", score.rmse_m, score.plan_of_allowed,
                  score.rmse_xyz_m[2], score.height_of_allowed,
                  coverage_text(score.in_interval, score.in_ellipsoid, score.local_maps).c_str())
        << format("| %.2f | %.3f | %d | %d | %d | %d | %s | %s | %d | %d | %d ",
                  score.rmse_estimated_m, score.length_ratio, score.verdicts, score.false_verdicts,
                  score.unconfirmed, score.route_home_verdicts, score.complete ? "yes" : "no",
                  score.false_complete() ? "yes" : "no", score.rescans, score.back_offs,
                  score.guard_stops)
        << format("| %zu; %zu | %.1f |\n", score.loop_closures, score.between_levels,
                  score.merged_m);
  }
}

void print_times(const std::vector<MissionRow>& rows) {
  std::string heading = "\n| mine, seconds ";
  for (std::size_t i = 0; i < kActivities; ++i)
    heading += format("| %s ", description_of(static_cast<Activity>(i)));
  print_heading(heading + "|");
  std::array<double, kActivities> sum_s{};
  std::array<double, kActivities> sum_m{};
  std::array<std::size_t, kActivities> times{};
  double all_s = 0.0;
  for (const auto& [name, world, score] : rows) {
    std::cout << format("| %s ", name.c_str());
    for (std::size_t i = 0; i < kActivities; ++i) {
      std::cout << format("| %.0f ", score.activity_s[i]);
      sum_s[i] += score.activity_s[i];
      sum_m[i] += score.activity_m[i];
      times[i] += score.activity_times[i];
      all_s += score.activity_s[i];
    }
    std::cout << "|\n";
  }
  print_heading("\n| activity | times | duration (s) | share (%) | distance (m) | speed (m/s) |");
  for (std::size_t i = 0; i < kActivities; ++i) {
    std::cout << format("| %s | %zu | %.0f | %.1f | %.0f | %.2f |\n",
                        description_of(static_cast<Activity>(i)), times[i], sum_s[i],
                        100.0 * sum_s[i] / std::max(all_s, 1.0), sum_m[i],
                        sum_m[i] / std::max(sum_s[i], 1.0));
  }
}

void print_summary(const std::vector<MissionRow>& rows, double wall_s) {
  MissionSums sum;
  for (const MissionRow& row : rows) sum.add(row.score);
  const double n = std::max<double>(1.0, static_cast<double>(rows.size()));
  std::cout
      << format("\n| %zu missions | |\n|---|---|\n", rows.size())
      << format("| returned; true position within 0.5 m of the start | %d; %d |\n", sum.returned,
                sum.returned_to_start)
      << format("| failed runs (e.g. collisions); crashed | %d; %d |\n", sum.failed, sum.crashed)
      << format("| corridor seen, mean | %.1f %% |\n", 100.0 * sum.covered_share / n)
      << format("| frontiers reported as blocked; falsely | %d; %d |\n", sum.verdicts,
                sum.false_verdicts)
      << format("| frontiers abandoned without a confirmed blockage | %d |\n", sum.unconfirmed)
      << format("| blockages reported on the return route or without a frontier | %d |\n",
                sum.route_home_verdicts)
      << format(
             "| reported complete; falsely; falsely for the vehicle with margin | %d; %d; %d |\n",
             sum.complete, sum.false_complete, sum.certainly_false_complete)
      << format("| guard stops | %d |\n", sum.guard_stops)
      << format("| loop closures; between levels; wrong by over 0.5 m | %zu; %zu; %zu |\n",
                sum.loop_closures, sum.between_levels, sum.wrong_loop_closures)
      << format("| path merged with another place | %.1f m |\n", sum.merged_m)
      << format("| largest RMSE of the map | %.2f m |\n", sum.rmse_max_m)
      << format("| largest RMSE over the allowed, in plan; in height | %.1f; %.1f |\n",
                sum.plan_of_allowed, sum.height_of_allowed)
      << format("| x, y, z of local maps in 95 %% interval; in ellipsoid | %s %% |\n",
                coverage_text(sum.in_interval, sum.in_ellipsoid, sum.local_maps).c_str())
      << format("| normalised error squared, mean (3 is consistent) | %.2f |\n",
                sum.normalised_error_squared /
                    std::max<double>(1.0, static_cast<double>(sum.local_maps)))
      << format("| path length, simulated time, wall time | %.0f m, %.0f s, %.0f s |\n",
                sum.distance_travelled_m, sum.simulated_s, wall_s);
}

}  // namespace adit

// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
// merge_table: joins runs of simulated mines, and compares the maps and every link between runs
// with the truth. --same: recorded runs of one mine. --alike: recorded runs of different mines,
// each with the next. --mines: for each seed ten walks of two robots from three places of a
// generated mine. --pairs, --plans, --tunnels: pairs of mines that are alike and never to be
// joined. Tables in Markdown; the exit code is 1 if a join is wrong.
#include <algorithm>
#include <array>
#include <cmath>
#include <exception>
#include <filesystem>
#include <iostream>
#include <limits>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include "tests/eval/merge/generated_runs.hpp"
#include "tests/eval/merge/merge_truth.hpp"

namespace adit {
namespace {

constexpr double kWrongM = 0.5;  // a link that errs by more is wrong

double rmse_m(const std::vector<PosePair>& pairs) {
  return position_errors(pairs, align(pairs)).rmse_m;
}

/// Of the places of each run alone, in order.
std::vector<double> rmse_alone_m(const std::vector<TrueRun>& runs) {
  std::vector<double> errors;
  for (const TrueRun& run : runs) {
    std::vector<PosePair> pairs;
    const std::vector<Pose2> poses = run.map->graph().poses;
    for (std::size_t i = 0; i < poses.size(); ++i) {
      if (const auto truth = interpolate(run.truth, run.map->local_maps()[i].utime))
        pairs.push_back({poses[i], *truth});
    }
    errors.push_back(rmse_m(pairs));
  }
  return errors;
}

struct SameScore {
  std::size_t runs = 0;
  std::size_t joined = 0;
  std::size_t links = 0;
  std::size_t wrong = 0;
  double largest_error_m = 0.0;  ///< of a link
  double contradicting = 0.0;    ///< largest share
  double best_alone_m = std::numeric_limits<double>::infinity();
  double rmse_m = 0.0;
  double cpu_s = 0.0;

  [[nodiscard]] bool good() const { return joined == runs && wrong == 0; }
};

void print_rejections(const MergedRuns& merged) {
  for (const RejectedJoin& rejected : merged.groups().rejected()) {
    std::cout << fmt::format("rejected: {} to the map of {}: {}\n", merged.name(rejected.run),
                             merged.name(rejected.to_run), rejected.join.reason);
  }
}

SameScore score_same(std::vector<TrueRun> runs, bool verbose) {
  SameScore score;
  score.runs = runs.size();
  const std::vector<double> alone_m = rmse_alone_m(runs);
  const MergedRuns merged(std::move(runs));
  const RunGroup& group = merged.groups().groups().front();
  if (verbose) {
    std::cout
        << "| run | local maps | links | places | rejected | largest error of a link (m) | "
           "walls that contradict (%) | walls apart (m) | RMSE alone (m) | RMSE in the map (m) |\n"
           "|---|---|---|---|---|---|---|---|---|---|\n";
  }
  for (const PlacedRun& run : group.runs) {
    score.best_alone_m = std::min(score.best_alone_m, alone_m[run.run]);
    std::string evidence = " | | | | | |";
    if (run.join) {
      const std::vector<double> errors = merged.link_errors_m(group, *run.join);
      score.wrong += static_cast<std::size_t>(
          std::ranges::count_if(errors, [](double error_m) { return error_m > kWrongM; }));
      score.links += errors.size();
      score.largest_error_m = std::max(score.largest_error_m, std::ranges::max(errors));
      score.contradicting = std::max(score.contradicting, run.join->contradicting_share());
      evidence = fmt::format(" {} | {} | {} | {:.3f} | {:.1f} | {:.3f} |", errors.size(),
                             run.join->places, run.join->rejected, std::ranges::max(errors),
                             100.0 * run.join->contradicting_share(), run.join->walls_apart_m);
    }
    if (verbose) {
      std::cout << fmt::format("| {} | {} |{} {:.3f} | {:.3f} |\n", merged.name(run.run), run.maps,
                               evidence, alone_m[run.run], rmse_m(merged.places(group, run)));
    }
  }
  score.joined = group.runs.size();
  score.rmse_m = rmse_m(merged.places(group));
  score.cpu_s = merged.cpu_s();
  if (verbose || !score.good()) print_rejections(merged);
  return score;
}

bool print_recorded(const std::vector<std::filesystem::path>& folders, double ahead_ms) {
  std::vector<TrueRun> runs;
  for (const std::filesystem::path& folder : folders)
    runs.push_back(open_true_run(folder, std::llround(1000.0 * ahead_ms)));
  const SameScore score = score_same(std::move(runs), true);
  std::cout << fmt::format(
      "\n{} of {} runs in one map, {} links, {} wrong; RMSE {:.4f} m, {:.2f} times that of the "
      "best single run ({:.4f} m); joined in {:.0f} s of CPU time\n",
      score.joined, score.runs, score.links, score.wrong, score.rmse_m,
      score.rmse_m / score.best_alone_m, score.best_alone_m, score.cpu_s);
  return score.good();
}

bool print_mines(int first, int count) {
  std::cout
      << "| mine | runs joined | links | wrong | largest error of a link (m) | walls that "
         "contradict, at most (%) | RMSE, best single run (m) | RMSE (m) | ratio | CPU (s) |\n"
         "|---|---|---|---|---|---|---|---|---|---|\n";
  bool good = true;
  for (int seed = first; seed < first + count; ++seed) {
    const SameScore score = score_same(ten_runs(seed), false);
    good &= score.good();
    std::cout << fmt::format(
                     "| {} | {} of {} | {} | {} | {:.3f} | {:.1f} | {:.4f} | {:.4f} | {:.2f} | "
                     "{:.0f} |\n",
                     mine_name(seed), score.joined, score.runs, score.links, score.wrong,
                     score.largest_error_m, 100.0 * score.contradicting, score.best_alone_m,
                     score.rmse_m, score.rmse_m / score.best_alone_m, score.cpu_s)
              << std::flush;
  }
  return good;
}

/// Joins pairs of runs of different mines; returns the number of wrong joins.
int print_pair(TrueRun a, TrueRun b) {
  std::vector<TrueRun> runs;
  runs.push_back(std::move(a));
  runs.push_back(std::move(b));
  const MergedRuns pair(std::move(runs));
  const bool joined = pair.groups().groups().size() == 1;
  const RunJoin& join = joined ? *pair.groups().groups().front().runs.back().join
                               : pair.groups().rejected().front().join;
  std::cout << fmt::format("| {}, {} | {} | {} | {} | {:.3f} | {} of {} | {:.0f} | {} |\n",
                           pair.name(0), pair.name(1), joined ? "**yes**" : "no", join.places,
                           join.rivals, join.walls_apart_m, join.found, join.searched, pair.cpu_s(),
                           join.reason)
            << std::flush;
  return joined ? 1 : 0;
}

template <class MakeA, class MakeB>
bool print_pairs(int first, int count, const MakeA& make_a, const MakeB& make_b) {
  std::cout << "\n| mines | joined | places | other alignments | walls apart (m) | poses found, of "
               "pairs of local maps | CPU (s) | because |\n|---|---|---|---|---|---|---|---|\n";
  int wrong = 0;
  for (int seed = first; seed < first + count; ++seed)
    wrong += print_pair(make_a(seed), make_b(seed));
  std::cout << fmt::format("\n{} wrong joins of {} pairs of different mines\n", wrong, count);
  return wrong == 0;
}

}  // namespace
}  // namespace adit

int main(int argc, char** argv) try {
  CLI::App app("Joins runs of simulated mines and compares the joins with the truth");
  std::vector<std::filesystem::path> same;
  std::vector<std::filesystem::path> alike;
  double ahead_ms = 0.0;
  std::vector<int> mines;
  std::vector<int> pairs;
  std::vector<int> plans;
  std::vector<int> tunnels;
  app.add_option("--same", same, "Folders of recorded runs of one mine");
  app.add_option("--alike", alike,
                 "Folders of recorded runs of different mines: each with the next");
  app.add_option("--ahead-ms", ahead_ms,
                 "Time by which the poses of recorded runs are ahead of the stamps of their scans");
  app.add_option("--mines", mines, "First seed and count of generated mines, ten runs in each")
      ->expected(2);
  app.add_option("--pairs", pairs, "First seed and count of pairs of mines of neighbouring seeds")
      ->expected(2);
  app.add_option("--plans", plans,
                 "First seed and count of pairs of mines of one plan with other walls")
      ->expected(2);
  app.add_option("--tunnels", tunnels,
                 "First seed and count of pairs of mines with the same straight tunnel")
      ->expected(2);
  CLI11_PARSE(app, argc, argv);
  using namespace adit;
  bool good = true;
  if (!same.empty()) good &= print_recorded(same, ahead_ms);
  if (!alike.empty()) {
    const int last = static_cast<int>(alike.size()) - 1;
    const auto open = [&](int i) { return open_true_run(alike[static_cast<std::size_t>(i)]); };
    good &= print_pairs(0, last, open, [&](int i) { return open(i + 1); });
  }
  if (!mines.empty()) good &= print_mines(mines[0], mines[1]);
  if (!pairs.empty()) {
    good &= print_pairs(
        pairs[0], pairs[1], [](int seed) { return whole_mine(seed, 1); },
        [](int seed) { return whole_mine(seed + 1, 2); });
  }
  if (!plans.empty()) {
    good &= print_pairs(
        plans[0], plans[1], [](int seed) { return whole_mine(seed, 1); },
        [](int seed) { return mine_with_other_walls(seed); });
  }
  if (!tunnels.empty()) {
    good &= print_pairs(
        tunnels[0], tunnels[1], [](int seed) { return straight_tunnel_run(seed, 0); },
        [](int seed) { return straight_tunnel_run(seed, 1); });
  }
  return good ? 0 : 1;
} catch (const std::exception& error) {
  std::cerr << "merge_table: " << error.what() << "\n";
  return 2;
}

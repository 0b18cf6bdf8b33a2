// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <iostream>

#include "tests/eval/benchmarks.hpp"
#include "tests/eval/mission_row.hpp"

namespace adit {
namespace {

struct Sum {
  int home = 0, failed = 0, crashed = 0, at_home = 0, verdicts = 0, false_verdicts = 0;
  int doubtful = 0, home_verdicts = 0, complete = 0, false_complete = 0, surely_false_complete = 0,
      guard_stops = 0;
  double seen_share = 0.0, travelled_m = 0.0, simulated_s = 0.0, rmse_max_m = 0.0;

  void add(const test::MissionScore& score) {
    home += score.outcome == "home";
    at_home += score.outcome == "home" && score.home_off_m <= 0.5;
    failed += score.outcome == "failed";
    crashed += score.outcome == "crashed";
    verdicts += score.verdicts;
    false_verdicts += score.false_verdicts;
    doubtful += score.doubtful;
    home_verdicts += score.home_verdicts;
    complete += score.complete;
    false_complete += score.false_complete();
    surely_false_complete += score.complete && score.sure_missed_m > 2.0;
    guard_stops += score.guard_stops;
    seen_share += score.seen_share;
    travelled_m += score.travelled_m;
    simulated_s += score.simulated_s;
    rmse_max_m = std::max(rmse_max_m, score.rmse_m);
  }
};

}  // namespace

void print_table(const std::vector<MissionRow>& rows) {
  std::cout
      << "| mine | outcome | from the start (m) | farthest (m) | corridor (m) | seen (%) "
         "| missed; by the vehicle with room (m) | way (m) | simulated (s) | wall (s) | scans | "
         "RMSE, map (m) "
         "| RMSE, believed (m) | length ratio | blocked | falsely | doubtful | on the way home "
         "| complete | falsely | other laser | back-offs | guard stops |\n"
         "|---|---|---|---|---|---|---|---|---|---|---|---|---|---|---|---|---|---|---|---|---|---"
         "|---|\n";
  for (const auto& [name, world, score] : rows) {
    std::cout
        << format("| %s | %s | %.2f | %.0f | %.0f | %.1f | %.0f; %.0f | %.0f | %.0f | %.0f | %d ",
                  name.c_str(), score.outcome.c_str(), score.home_off_m, score.farthest_m,
                  score.corridor_m, 100.0 * score.seen_share, score.missed_m, score.sure_missed_m,
                  score.travelled_m, score.simulated_s, score.wall_s, score.scans)
        << format("| %.2f | %.2f | %.3f | %d | %d | %d | %d | %s | %s | %d | %d | %d |\n",
                  score.rmse_m, score.rmse_believed_m, score.length_ratio, score.verdicts,
                  score.false_verdicts, score.doubtful, score.home_verdicts,
                  score.complete ? "yes" : "no", score.false_complete() ? "yes" : "no",
                  score.other_laser, score.back_offs, score.guard_stops);
  }
}

void print_summary(const std::vector<MissionRow>& rows, double wall_s) {
  Sum sum;
  for (const MissionRow& row : rows) sum.add(row.score);
  const double n = std::max<double>(1.0, static_cast<double>(rows.size()));
  std::cout << format("\n| of %zu missions | |\n|---|---|\n", rows.size())
            << format("| ended at home; by the truth within 0.5 m of the start | %d; %d |\n",
                      sum.home, sum.at_home)
            << format("| runs that failed (collisions, for one); that crashed | %d; %d |\n",
                      sum.failed, sum.crashed)
            << format("| corridor seen, mean | %.1f %% |\n", 100.0 * sum.seen_share / n)
            << format("| verdicts that a stub is blocked; of them false | %d; %d |\n", sum.verdicts,
                      sum.false_verdicts)
            << format("| stubs given up that nobody saw to be blocked | %d |\n", sum.doubtful)
            << format("| verdicts on the way home or without a stub | %d |\n", sum.home_verdicts)
            << format(
                   "| called complete; of them falsely; for the vehicle with room | %d; %d; %d |\n",
                   sum.complete, sum.false_complete, sum.surely_false_complete)
            << format("| guard stops | %d |\n", sum.guard_stops)
            << format("| largest RMSE of the map | %.2f m |\n", sum.rmse_max_m)
            << format("| way, simulated time, wall time | %.0f m, %.0f s, %.0f s |\n",
                      sum.travelled_m, sum.simulated_s, wall_s);
}

}  // namespace adit

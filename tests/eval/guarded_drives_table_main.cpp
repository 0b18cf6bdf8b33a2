// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
// guarded_drives_table [MINES [FIRST [LOOKS [LANE]]]]: in random drifts the robot looks, plans and
// drives, LOOKS times in each of MINES, with a guard. LANE metres are left beside obstacles. Prints
// what became of that, as Markdown, and each hold of the guard and each drive that did not arrive
// on standard error.
#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <vector>

#include "tests/support/drift_to_drive.hpp"
#include "tests/support/guarded_drives.hpp"
#include "tests/support/path_drive.hpp"

namespace adit {
namespace {

constexpr double kLongHoldS = 2.0;
constexpr double kStopsM = 0.35;  // in which the vehicle stops from 0.4 m/s, with the margin

struct Score {
  int looks = 0;
  int drives = 0;
  int arrived = 0;
  int lost = 0;
  int failures = 0;
  int holds = 0;
  int long_holds = 0;
  int needless_holds = 0;
  int ended_by_guard = 0;
  double way_m = 0.0;
  double seconds = 0.0;
  std::vector<double> lateral_m;

  void add(const GuardedDrive& drive) {
    ++looks;
    if (!drive.failure.empty()) ++failures;
    if (drive.outcome != PlanOutcome::kFound) return;
    ++drives;
    arrived += drive.arrived() ? 1 : 0;
    const bool failed = drive.state.kind == DrivingState::Kind::kFailed;
    const bool held = drive.state.reason.find("held") == 0;
    lost += failed && !held ? 1 : 0;
    ended_by_guard += failed && held ? 1 : 0;
    holds += static_cast<int>(drive.holds.size());
    for (const GuardHold& hold : drive.holds) {
      long_holds += hold.seconds > kLongHoldS ? 1 : 0;
      needless_holds += hold.free_m >= kStopsM ? 1 : 0;
    }
    way_m += drive.state.progress_m;
    seconds += drive.seconds;
    lateral_m.insert(lateral_m.end(), drive.lateral_m.begin(), drive.lateral_m.end());
  }
};

void tell(int mine, std::size_t look, const GuardedDrive& drive) {
  if (!drive.failure.empty()) {
    std::fprintf(stderr, "mine %d, look %zu: %s\n", mine, look, drive.failure.c_str());
  }
  if (drive.outcome != PlanOutcome::kFound) {
    std::fprintf(stderr, "mine %d, look %zu: %s\n", mine, look, drive.reason.c_str());
    return;
  }
  for (const GuardHold& hold : drive.holds) {
    std::fprintf(stderr,
                 "mine %d, look %zu, %.2f of %.2f m, held %.1f s, free %.2f m, "
                 "clearance %.2f m, beside %.2f m: %s\n",
                 mine, look, hold.at_m, drive.path_m, hold.seconds, hold.free_m, hold.clearance_m,
                 hold.lateral_m, hold.reason.c_str());
  }
  if (drive.arrived()) return;
  std::fprintf(stderr, "mine %d, look %zu, did not arrive, %.2f m are left: %s\n", mine, look,
               drive.state.remaining_m, drive.state.reason.c_str());
}

void run(int mines, int first, int looks, double lane_m) {
  Score score;
  for (int mine = first; mine < first + mines; ++mine) {
    const auto drives = drive_guarded(drift_to_drive(mine, lane_m), looks);
    for (std::size_t i = 0; i < drives.size(); ++i) {
      tell(mine, i + 1, drives[i]);
      score.add(drives[i]);
    }
  }
  const double all = std::max(1, score.drives);
  std::printf("| of %d mines | |\n|---|---|\n", mines);
  std::printf("| looks, paths found | %d, %d |\n", score.looks, score.drives);
  std::printf("| way driven, mean speed | %.0f m, %.2f m/s |\n", score.way_m,
              score.way_m / std::max(1.0, score.seconds));
  std::printf("| runs that failed (collisions, for one) | %d |\n", score.failures);
  std::printf("| arrived | %d (%.1f %%) |\n", score.arrived, 100.0 * score.arrived / all);
  std::printf("| lost their path | %d |\n", score.lost);
  std::printf("| ended by the guard | %d |\n", score.ended_by_guard);
  std::printf("| holds by the guard, of them longer than 2 s | %d, %d |\n", score.holds,
              score.long_holds);
  std::printf("| holds with 0.35 m truly free, margins included | %d |\n", score.needless_holds);
  std::printf("| true lateral error, 95 %% / worst | %.1f / %.1f cm |\n",
              100.0 * quantile(score.lateral_m, 0.95), 100.0 * quantile(score.lateral_m, 1.0));
}

}  // namespace
}  // namespace adit

int main(int argc, char** argv) {
  const auto number = [&](int i, double without) {
    return argc > i ? std::atof(argv[i]) : without;
  };
  adit::run(std::max(1, static_cast<int>(number(1, 20))), static_cast<int>(number(2, 1)),
            std::max(1, static_cast<int>(number(3, 3))), number(4, 2.2));
}

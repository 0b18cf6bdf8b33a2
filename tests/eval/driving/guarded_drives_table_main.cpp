// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
// guarded_drives_table [MINES [FIRST [SCANS [LANE]]]]: the robot scans, plans and drives with a
// guard, SCANS times in each of MINES random tunnels from number FIRST, with a free lane of LANE
// metres beside obstacles. Prints the results as a table in Markdown, and each guard stop and each
// drive that did not arrive to standard error.
#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <vector>

#include "tests/support/drives/guarded_drives.hpp"
#include "tests/support/drives/path_drive.hpp"

namespace adit {
namespace {

constexpr double kLongStopS = 2.0;
constexpr double kGuardStopDistanceM = 0.35;  // stopping distance from 0.4 m/s, with margin

struct Score {
  int scans = 0;
  int drives = 0;
  int arrived = 0;
  int lost = 0;
  int failures = 0;
  int guard_stops = 0;
  int long_stops = 0;
  int unnecessary_stops = 0;
  int ended_by_guard = 0;
  double path_length_m = 0.0;
  double seconds = 0.0;
  std::vector<double> cross_track_error_m;

  void add(const GuardedDrive& drive) {
    ++scans;
    if (!drive.failure.empty()) ++failures;
    if (drive.outcome != PlanOutcome::kFound) return;
    ++drives;
    arrived += drive.arrived() ? 1 : 0;
    const bool failed = drive.state.kind == DrivingState::Kind::kFailed;
    const bool stopped_by_guard = drive.state.reason.starts_with("held");
    lost += failed && !stopped_by_guard ? 1 : 0;
    ended_by_guard += failed && stopped_by_guard ? 1 : 0;
    guard_stops += static_cast<int>(drive.guard_stops.size());
    for (const GuardStop& guard_stop : drive.guard_stops) {
      long_stops += guard_stop.seconds > kLongStopS ? 1 : 0;
      unnecessary_stops += guard_stop.free_m >= kGuardStopDistanceM ? 1 : 0;
    }
    path_length_m += drive.state.progress_m;
    seconds += drive.seconds;
    cross_track_error_m.insert(cross_track_error_m.end(), drive.cross_track_error_m.begin(),
                               drive.cross_track_error_m.end());
  }
};

void print_failures(int mine, std::size_t scan, const GuardedDrive& drive) {
  if (!drive.failure.empty()) {
    std::fprintf(stderr, "mine %d, scan %zu: %s\n", mine, scan, drive.failure.c_str());
  }
  if (drive.outcome != PlanOutcome::kFound) {
    std::fprintf(stderr, "mine %d, scan %zu: %s\n", mine, scan, drive.reason.c_str());
    return;
  }
  for (const GuardStop& guard_stop : drive.guard_stops) {
    std::fprintf(stderr,
                 "mine %d, scan %zu, %.2f of %.2f m, stopped %.1f s, free %.2f m, "
                 "clearance %.2f m, cross-track error %.2f m: %s\n",
                 mine, scan, guard_stop.at_m, drive.path_m, guard_stop.seconds, guard_stop.free_m,
                 guard_stop.clearance_m, guard_stop.cross_track_error_m, guard_stop.reason.c_str());
  }
  if (drive.arrived()) return;
  std::fprintf(stderr, "mine %d, scan %zu, did not arrive, %.2f m remaining: %s\n", mine, scan,
               drive.state.remaining_m, drive.state.reason.c_str());
}

void run(int mines, int first, int scans, double lane_m) {
  Score score;
  for (int mine = first; mine < first + mines; ++mine) {
    const auto drives = drive_guarded(random_tunnel(mine, lane_m), scans);
    for (std::size_t i = 0; i < drives.size(); ++i) {
      print_failures(mine, i + 1, drives[i]);
      score.add(drives[i]);
    }
  }
  const double all = std::max(1, score.drives);
  std::printf("| %d mines | |\n|---|---|\n", mines);
  std::printf("| scans, paths found | %d, %d |\n", score.scans, score.drives);
  std::printf("| distance travelled, mean speed | %.0f m, %.2f m/s |\n", score.path_length_m,
              score.path_length_m / std::max(1.0, score.seconds));
  std::printf("| failed runs (e.g. collisions) | %d |\n", score.failures);
  std::printf("| arrived | %d (%.1f %%) |\n", score.arrived, 100.0 * score.arrived / all);
  std::printf("| path lost | %d |\n", score.lost);
  std::printf("| ended by the guard | %d |\n", score.ended_by_guard);
  std::printf("| guard stops, longer than 2 s | %d, %d |\n", score.guard_stops, score.long_stops);
  std::printf("| guard stops with at least 0.35 m free, margins included | %d |\n",
              score.unnecessary_stops);
  std::printf("| true cross-track error, 95 %% / largest | %.1f / %.1f cm |\n",
              100.0 * absolute_quantile(score.cross_track_error_m, 0.95),
              100.0 * absolute_quantile(score.cross_track_error_m, 1.0));
}

}  // namespace
}  // namespace adit

int main(int argc, char** argv) {
  const auto number = [&](int i, double default_value) {
    return argc > i ? std::atof(argv[i]) : default_value;
  };
  adit::run(std::max(1, static_cast<int>(number(1, 20))), static_cast<int>(number(2, 1)),
            std::max(1, static_cast<int>(number(3, 3))), number(4, 2.2));
}

// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
// path_following_table [DRIVES [CORRIDORS [RADIUS]]]: cross-track error of the simulated vehicle by
// path, controller, steering and direction (95 % / largest, in cm), as a table in Markdown. Each
// path shape is driven DRIVES times with different noise and slip, each of CORRIDORS planned paths
// once. The tightest bends of the shapes have RADIUS metres.
#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <functional>
#include <numeric>
#include <string>
#include <vector>

#include "tests/support/drives/path_drive.hpp"
#include "tests/support/drives/test_paths.hpp"

namespace adit {
namespace {

constexpr const char* kControllers[] = {"pd", "pure_pursuit"};
constexpr const char* kSteerings[] = {"four_wheel", "ackermann"};

/// Errors of several drives.
struct Score {
  std::vector<double> cross_track_error_m;
  std::vector<double> oscillations_per_m;
  std::vector<double> steering_rms_1_m_s;
  std::vector<double> end_m;
  std::vector<double> end_rad;
  int drives = 0;
  int arrived = 0;

  void add(const PathDrive& drive) {
    ++drives;
    cross_track_error_m.insert(cross_track_error_m.end(), drive.cross_track_error_m.begin(),
                               drive.cross_track_error_m.end());
    oscillations_per_m.push_back(drive.oscillations_per_m);
    steering_rms_1_m_s.push_back(drive.steering_rms_1_m_s);
    if (drive.end != DrivingState::Kind::kArrived) return;
    ++arrived;
    end_m.push_back(drive.T_end_body.translation().norm());
    end_rad.push_back(drive.T_end_body.theta);
  }

  void add(const Score& other) {
    const auto append = [](std::vector<double>& to, const std::vector<double>& from) {
      to.insert(to.end(), from.begin(), from.end());
    };
    append(cross_track_error_m, other.cross_track_error_m);
    append(oscillations_per_m, other.oscillations_per_m);
    append(steering_rms_1_m_s, other.steering_rms_1_m_s);
    append(end_m, other.end_m);
    append(end_rad, other.end_rad);
    drives += other.drives;
    arrived += other.arrived;
  }
};

double mean(const std::vector<double>& values) {
  return std::accumulate(values.begin(), values.end(), 0.0) /
         std::max(1.0, static_cast<double>(values.size()));
}

using MakePath = std::function<PlannedPath(int drive, const Vehicle& vehicle)>;

struct Row {
  std::string name;
  int drives;
  bool also_reverse;
  MakePath path;
};

Score drive_all(const Row& row, const char* steering, const char* controller, bool reverse) {
  Score score;
  for (int i = 0; i < row.drives; ++i) {
    PathDriveSetup setup;
    setup.driving.vehicle.steering = steering;
    setup.driving.controller = controller;
    setup.seed = static_cast<std::uint64_t>(i) + 1;
    const PlannedPath path = row.path(i, setup.driving.vehicle);
    if (path.points.empty()) continue;
    score.add(drive_path(reverse ? driven_in_reverse(path) : path, setup));
  }
  return score;
}

std::vector<Row> rows(int drives, int corridors, double radius_m) {
  std::vector<Row> rows;
  const auto names = path_shapes(Vehicle{}, radius_m);
  for (std::size_t i = 0; i < names.size(); ++i) {
    rows.push_back({names[i].name, drives, true, [i, radius_m](int, const Vehicle& vehicle) {
                      return path_shapes(vehicle, radius_m)[i].path;
                    }});
  }
  rows.push_back({"straight, initial error 7 cm and 5.6°", drives, true,
                  [](int drive, const Vehicle& vehicle) {
                    const double side = drive % 2 == 0 ? 1.0 : -1.0;
                    const double turn = drive % 4 < 2 ? 1.0 : -1.0;
                    const Pose2 start{0.0, 0.07 * side, deg_to_rad(5.6) * turn};
                    return TestPathBuilder(vehicle, start).forward(12.0).path();
                  }});
  rows.push_back(
      {"planned, random corridors", corridors, false, [](int drive, const Vehicle& vehicle) {
         return random_corridor_path(static_cast<std::uint32_t>(drive), vehicle);
       }});
  return rows;
}

void print(const Score& score) {
  std::printf(" %.1f / %.1f", 100.0 * absolute_quantile(score.cross_track_error_m, 0.95),
              100.0 * absolute_quantile(score.cross_track_error_m, 1.0));
  if (score.arrived < score.drives) std::printf(", %d lost", score.drives - score.arrived);
  std::printf(" |");
}

/// Prints the longest distance from the last pose to standstill on a straight path.
void print_stops(int drives) {
  double worst_m = 0.0;
  double speed_m_s = 0.0;
  for (int i = 0; i < drives; ++i) {
    PathDriveSetup setup;
    setup.seed = static_cast<std::uint64_t>(i) + 1;
    setup.poses_end_m = 4.0 + 0.002 * i;  // varies the time between two commands
    const PathDrive drive =
        drive_path(TestPathBuilder(setup.driving.vehicle).forward(12.0).path(), setup);
    if (drive.distance_without_poses_m < worst_m) continue;
    worst_m = drive.distance_without_poses_m;
    speed_m_s = drive.speed_at_last_pose_m_s;
  }
  std::printf("\nPoses time out: standstill after %.2f m, from %.2f m/s (worst of %d drives).\n",
              worst_m, speed_m_s, drives);
}

void run(int drives, int corridors, double radius_m) {
  Score totals[2];
  std::printf("| path | steering | PD | PD, reverse | pure pursuit | pure pursuit, reverse |\n");
  std::printf("|---|---|---|---|---|---|\n");
  for (const Row& row : rows(drives, corridors, radius_m)) {
    for (const char* steering : kSteerings) {
      std::printf("| %s | %s |", row.name.c_str(), steering);
      for (int c = 0; c < 2; ++c) {
        for (const bool reverse : {false, true}) {
          if (reverse && !row.also_reverse) {
            std::printf(" – |");
            continue;
          }
          const Score score = drive_all(row, steering, kControllers[c], reverse);
          print(score);
          std::fflush(stdout);
          totals[c].add(score);
        }
      }
      std::printf("\n");
    }
  }
  std::printf("\n| all drives | PD | pure pursuit |\n|---|---|---|\n");
  const auto line = [&](const char* name, const char* format, const auto& value) {
    std::printf("| %s |", name);
    for (const Score& total : totals) std::printf(format, value(total));
    std::printf("\n");
  };
  line("drives", " %.0f |", [](const Score& s) { return 1.0 * s.drives; });
  line("arrived [%]", " %.1f |", [](const Score& s) { return 100.0 * s.arrived / s.drives; });
  line("final position error, 95 % [cm]", " %.1f |",
       [](const Score& s) { return 100.0 * absolute_quantile(s.end_m, 0.95); });
  line("final heading error, 95 % [°]", " %.1f |",
       [](const Score& s) { return rad_to_deg(absolute_quantile(s.end_rad, 0.95)); });
  line("oscillations, mean [1/m]", " %.2f |",
       [](const Score& s) { return mean(s.oscillations_per_m); });
  line("oscillations, 95 % [1/m]", " %.2f |",
       [](const Score& s) { return absolute_quantile(s.oscillations_per_m, 0.95); });
  line("RMS steering rate, 95 % [1/m/s]", " %.2f |",
       [](const Score& s) { return absolute_quantile(s.steering_rms_1_m_s, 0.95); });
  print_stops(drives);
}

}  // namespace
}  // namespace adit

int main(int argc, char** argv) {
  const auto number = [&](int i, double default_value) {
    return argc > i ? std::atof(argv[i]) : default_value;
  };
  adit::run(std::max(1, static_cast<int>(number(1, 20))),
            std::max(0, static_cast<int>(number(2, 100))), number(3, 1.6));
}

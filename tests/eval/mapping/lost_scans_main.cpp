// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
// lost_scans_table [--mines N] [--missions] --out DIR: does a map with a lost stretch of scans know
// when it is wrong? Generated mines with parallel entries, alternately level and not: drives
// through all entries and crosscuts (or missions, in which both lasers give nothing for some
// seconds). Each log is mapped without the scans of 5, 10 or 20 m of the path, with and without
// wheels and IMU. A map is right if the mean error of its relations against the truth is at most
// 0.1 m. Otherwise it must report: a mission a contradiction, or that it is not sure to be at home;
// a map a doubtful stretch within 5 m of the lost one.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <exception>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <map>
#include <numbers>
#include <string>
#include <vector>

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include "common/bus/channels.hpp"
#include "common/bus/log/event_source.hpp"
#include "common/messages/codec.hpp"
#include "common/messages/mapping/association.hpp"
#include "common/messages/sensing.hpp"
#include "sim/world/build_world.hpp"
#include "tests/eval/mapping/reported_map.hpp"
#include "tests/eval/markdown.hpp"
#include "tests/support/scores/mission_log.hpp"
#include "tools/drive/drive_run.hpp"
#include "tools/eval/trajectory_score.hpp"
#include "tools/mission/mission_run.hpp"

namespace adit {
namespace {

constexpr double kRightM = 0.1;    // maps with all scans have 0.01 to 0.05
constexpr std::size_t kEach = 12;  // of the scans of a mission is kept: 3 Hz
constexpr const char* kDriveConfig = "sim:\n  laser:\n    scan_decimation: 12\n";
constexpr double kLengthM = 130.0;
constexpr double kTimeMaxS = 1800.0;

struct Options {
  int first = 1;
  int mines = 20;
  std::filesystem::path folder;
  bool missions = false;
  bool keep_logs = false;
};

/// A mine, and what is lost in it; the fractions are spread evenly over the mines (golden ratio).
struct Case {
  int number = 0;
  WorldChoice world;
  double outage_at_s = 0.0;
  double outage_s = 0.0;
  double lost_at_share = 0.0;  ///< of the path
  double lost_m = 0.0;
};

/// Drives are in mines without damage, which blocks them.
Case case_of(int number, bool mission) {
  constexpr std::array kDamages{0.0, 0.25, 0.5};
  constexpr std::array kLostM{5.0, 10.0, 20.0};
  constexpr std::array kOutagesS{5.0, 10.0, 15.0, 20.0};
  const auto n = static_cast<std::size_t>(number);
  const double fraction = std::fmod(0.618 * number, 1.0);
  Case of;
  of.number = number;
  of.world.name = number % 2 == 0 ? "random" : "random_level";
  of.world.seed = number;
  of.world.length_m = kLengthM;
  of.world.topology = "parallel_entries";
  of.world.damage = mission ? kDamages[n % kDamages.size()] : 0.0;
  of.outage_at_s = 50.0 + 200.0 * fraction;
  of.outage_s = kOutagesS[n % kOutagesS.size()];
  of.lost_at_share = 0.2 + 0.6 * fraction;
  of.lost_m = kLostM[n % kLostM.size()];
  return of;
}

struct Total {
  int maps = 0;
  int right = 0;
  int reported = 0;
  int unreported = 0;
};

struct Row {
  std::string lost;
  std::string sensors;
  double error_m = 0.0;
  std::size_t stretches = 0;
  bool reported = false;
  std::string outcome;
};

void print_row(const Case& of, const Row& row, Total& total) {
  const bool right = row.error_m <= kRightM;
  ++total.maps;
  total.right += right ? 1 : 0;
  total.reported += !right && row.reported ? 1 : 0;
  total.unreported += !right && !row.reported ? 1 : 0;
  std::cout << fmt::format("| {}:{} | {} | {} | {} | {:.3f} | {} | {} | {} |\n", of.world.name,
                           of.number, row.lost, row.sensors, row.outcome, row.error_m,
                           right ? "yes" : "no", row.stretches,
                           !right && !row.reported ? "yes" : "")
            << std::flush;
}

/// The number of contradictions at the end of a mission.
std::size_t contradictions_of(const std::filesystem::path& log) {
  std::size_t found = 0;
  LogReader events(log);
  while (const auto event = events.next()) {
    if (event->channel != channels::kContradictions) continue;
    const auto message = decode<map_contradictions_t>(event->data);
    if (!message) continue;
    if (const auto contradictions = from_message(*message)) found = contradictions->pairs.size();
  }
  return found;
}

std::string outcome_of(const test::MissionLog& log) {
  if (!log.failure.empty()) return "failed";
  if (log.phases.empty() || log.phases.back().phase != Phase::kEnded) return "timed out";
  return log.phases.back().outcome == MissionOutcome::kHome ? "home" : "not sure to be at home";
}

/// The part of the path on which scans are lost.
struct LostPart {
  double from_m = 0.0;
  double to_m = 0.0;
  std::int64_t from_utime = 0;
  std::int64_t to_utime = 0;
};

LostPart lost_part(const Case& of, const Trajectory& truth, const std::vector<double>& along) {
  LostPart part;
  part.from_m = of.lost_at_share * along.back();
  part.to_m = part.from_m + of.lost_m;
  const auto utime_at = [&](double m) {
    const auto at = std::ranges::lower_bound(along, m) - along.begin();
    return truth[std::min(static_cast<std::size_t>(at), truth.size() - 1)].utime;
  };
  part.from_utime = utime_at(part.from_m);
  part.to_utime = utime_at(part.to_m);
  return part;
}

/// Copies a log with each `each`-th scan, and without those in the lost part.
void write_cut(const std::filesystem::path& log, const std::filesystem::path& cut,
               const LostPart& lost, std::size_t each) {
  LogReader events(log);
  LogWriter out(cut);
  std::map<std::string, std::size_t, std::less<>> scans;
  while (const auto event = events.next()) {
    if (laser_from_channel(event->channel)) {
      if (event->utime >= lost.from_utime && event->utime <= lost.to_utime) continue;
      if (scans[std::string(event->channel)]++ % each != 0) continue;
    }
    out.write(*event);
  }
  out.close();
}

/// Maps a log without the lost part, with each `each`-th of its scans.
void print_maps(const Case& of, const std::filesystem::path& log, const Trajectory& truth,
                const std::string& outcome, std::size_t each, Total& maps) {
  const std::vector<double> along = distances(truth);
  const LostPart lost = lost_part(of, truth, along);
  std::vector<Relation> relations = relations_of(truth);
  // A map has no poses where scans are lost.
  std::erase_if(relations, [&](const Relation& relation) {
    const auto is_lost = [&](std::int64_t utime) {
      return utime >= lost.from_utime && utime <= lost.to_utime;
    };
    return is_lost(relation.utime_1) || is_lost(relation.utime_2);
  });
  const std::filesystem::path cut = log.parent_path() / "cut.lcmlog";
  write_cut(log, cut, lost, each);
  for (const bool use_odometry : {true, false}) {
    const ReportedMap map = map_log(cut, use_odometry);
    const bool reported = reports(map, truth, along, lost.from_m, lost.to_m);
    print_row(of,
              {fmt::format("{:.0f} m", of.lost_m), use_odometry ? "all" : "lasers only",
               error_m(relations, map.trajectory), map.stretches.size(), reported, outcome},
              maps);
  }
  std::filesystem::remove(cut);
}

void run_mission_case(const Case& of, const std::filesystem::path& folder, Total& missions,
                      Total& maps) {
  MissionRunOptions run;
  run.world = of.world;
  run.folder = folder;
  run.time_max_s = kTimeMaxS;
  for (const char* laser : {"front", "rear"}) {
    run.faults.push_back(fmt::format("laser_dies:{}@{:.1f}", laser, of.outage_at_s));
    run.faults.push_back(
        fmt::format("laser_recovers:{}@{:.1f}", laser, of.outage_at_s + of.outage_s));
  }
  run_mission(run);
  const std::filesystem::path log = folder / "run.lcmlog";
  const test::MissionLog mission = test::read_mission(log);
  const std::size_t contradictions = contradictions_of(log);
  const std::string outcome = outcome_of(mission);
  print_row(of,
            {fmt::format("{:.0f} s", of.outage_s), "all, in the mission",
             error_m(relations_of(mission.truth), mission.mapped), contradictions,
             contradictions > 0 || outcome != "home", outcome},
            missions);
  print_maps(of, log, mission.truth, outcome, kEach, maps);
}

/// Along the centre lines of a mine, always into the junction's least driven tunnel; not into dead
/// ends, in which the vehicle cannot turn. Corners are rounded.
std::vector<Eigen::Vector2d> tour(const TunnelGraph& mine, double length_m) {
  constexpr double kRadiusM = 2.2;  // of bends
  std::vector<std::size_t> ends(mine.nodes.size(), 0);
  for (const TunnelEdge& edge : mine.edges) {
    ++ends[static_cast<std::size_t>(edge.from)];
    ++ends[static_cast<std::size_t>(edge.to)];
  }
  std::vector<int> driven(mine.edges.size(), 0);
  std::vector<Eigen::Vector2d> line;
  const auto entrance = std::ranges::find(mine.nodes, true, &TunnelNode::entrance);
  int at = static_cast<int>(entrance - mine.nodes.begin());
  int last = -1;
  double driven_m = 0.0;
  while (driven_m < length_m) {
    int next = -1;
    for (int i = 0; i < static_cast<int>(mine.edges.size()); ++i) {
      const TunnelEdge& edge = mine.edges[static_cast<std::size_t>(i)];
      if (i == last || (edge.from != at && edge.to != at)) continue;
      const int to = edge.from == at ? edge.to : edge.from;
      if (ends[static_cast<std::size_t>(to)] < 2) continue;
      const auto times = [&](int e) { return driven[static_cast<std::size_t>(e)]; };
      if (next < 0 || times(i) < times(next)) next = i;
    }
    if (next < 0) break;
    const TunnelEdge& edge = mine.edges[static_cast<std::size_t>(next)];
    std::vector<Eigen::Vector2d> points = edge.points;
    if (edge.from != at) std::ranges::reverse(points);
    line.insert(line.end(), points.begin() + (line.empty() ? 0 : 1), points.end());
    at = edge.from == at ? edge.to : edge.from;
    ++driven[static_cast<std::size_t>(next)];
    last = next;
    driven_m += edge.length_m;
  }
  std::vector<Eigen::Vector2d> rounded;
  for (std::size_t i = 1; i + 1 < line.size(); ++i) {
    const Eigen::Vector2d before = line[i - 1] - line[i];
    const Eigen::Vector2d after = line[i + 1] - line[i];
    const double cosine = before.normalized().dot(after.normalized());
    const double turn = std::numbers::pi - std::acos(std::clamp(cosine, -1.0, 1.0));
    const double cut_m =
        std::min({kRadiusM * std::tan(0.5 * turn), 0.45 * before.norm(), 0.45 * after.norm()});
    constexpr int kPoints = 6;
    for (int k = 0; k <= kPoints; ++k) {  // a parabola from leg to leg
      const double t = static_cast<double>(k) / kPoints;
      rounded.emplace_back(line[i] + (1.0 - t) * (1.0 - t) * cut_m * before.normalized() +
                           t * t * cut_m * after.normalized());
    }
  }
  return rounded;
}

/// False if the vehicle did not get far enough, as where posts block it.
bool run_drive_case(const Case& of, const std::filesystem::path& folder, Total& maps) {
  constexpr double kTourM = 220.0;
  constexpr double kFarEnoughM = 80.0;
  std::filesystem::create_directories(folder);
  std::ofstream(folder / "drive.yaml") << kDriveConfig;
  std::ofstream waypoints(folder / "waypoints.txt");
  const World world = build_world(describe(of.world));
  for (const Eigen::Vector2d& p : tour(world.truth.tunnels, kTourM)) {
    if (p.x() > world.T_world_start.x + 1.0) waypoints << fmt::format("{} {}\n", p.x(), p.y());
  }
  waypoints.close();
  DriveRunOptions drive;
  drive.world = of.world;
  drive.waypoints = folder / "waypoints.txt";
  drive.log = folder / "run.lcmlog";
  drive.config = folder / "drive.yaml";
  const DriveRunResult result = run_drive(drive);
  if (!result.failure.empty()) {
    std::cerr << fmt::format("{}:{}: {} after {:.0f} m\n", of.world.name, of.number, result.failure,
                             result.distance_travelled_m);
  }
  if (result.distance_travelled_m < kFarEnoughM) return false;
  print_maps(of, drive.log, downsampled(read_ground_truth(drive.log), 0.05),
             fmt::format("{:.0f} m driven", result.distance_travelled_m), 1, maps);
  return true;
}

void print_total(const char* what, const Total& total) {
  std::cout << fmt::format("{} {}: {} right, {} wrong and reported, {} unreported failures\n",
                           total.maps, what, total.right, total.reported, total.unreported);
}

void print_table(const Options& options) {
  print_heading(
      "| mine | lost | sensors | outcome | error (m) | right "
      "| contradictions or doubtful stretches | unreported failure |");
  Total missions;
  Total maps;
  int mines = 0;
  for (int number = options.first; mines < options.mines; ++number) {
    const Case of = case_of(number, options.missions);
    const auto folder = options.folder / fmt::format("{}_{}", of.world.name, of.number);
    std::filesystem::remove_all(folder);
    if (options.missions) {
      run_mission_case(of, folder, missions, maps);
      ++mines;
    } else if (run_drive_case(of, folder, maps)) {
      ++mines;
    }
    if (!options.keep_logs) std::filesystem::remove(folder / "run.lcmlog");
  }
  std::cout << "\n";
  if (options.missions) print_total("missions", missions);
  print_total("maps", maps);
}

}  // namespace
}  // namespace adit

int main(int argc, char** argv) try {
  CLI::App app("Drives or missions and maps with a lost stretch of scans, as a table");
  adit::Options options;
  app.add_option("--first", options.first, "Number of the first mine")
      ->check(CLI::NonNegativeNumber)
      ->capture_default_str();
  app.add_option("--mines", options.mines, "Number of mines")
      ->check(CLI::PositiveNumber)
      ->capture_default_str();
  app.add_option("--out", options.folder, "Folder for drives or missions")->required();
  app.add_flag("--missions", options.missions, "Missions instead of drives");
  app.add_flag("--keep-logs", options.keep_logs, "Keep the logs");
  CLI11_PARSE(app, argc, argv);
  adit::print_table(options);
  return EXIT_SUCCESS;
} catch (const std::exception& error) {
  std::cerr << "lost_scans_table: " << error.what() << "\n";
  return 2;
}

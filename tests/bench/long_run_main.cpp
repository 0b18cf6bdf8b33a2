// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
// long_run: time and memory of scan matching and mapping on a long log as the map grows, and the
// error of the map by the ground truth, as a table in Markdown.
#include <algorithm>
#include <chrono>
#include <cstdio>
#include <exception>
#include <filesystem>
#include <iostream>
#include <optional>
#include <string>
#include <vector>

#include <CLI/CLI.hpp>
#include <malloc.h>

#include "common/bus/channels.hpp"
#include "common/bus/log/event_source.hpp"
#include "common/messages/codec.hpp"
#include "common/messages/mapping/association.hpp"
#include "common/messages/mapping/local_map.hpp"
#include "common/messages/sensing.hpp"
#include "procs/mapping/mapping.hpp"
#include "procs/scan_matching/scan_matching.hpp"
#include "tools/eval/path_error.hpp"
#include "tools/eval/trajectory.hpp"
#include "tools/map/summary.hpp"

namespace adit {
namespace {

constexpr double kRightM = 0.5;  // largest error of a right loop closure
constexpr double kMb = 1e6;

double seconds_since(std::chrono::steady_clock::time_point begin) {
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
}

double cpu_s() { return process_cost().cpu_s; }

/// Currently allocated heap [bytes].
double heap_bytes() {
  const auto heap = mallinfo2();
  return static_cast<double>(heap.uordblks + heap.hblkhd);
}

template <class Msg>
auto read(const LogEventView& event) -> decltype(from_message(Msg{})) {
  const auto message = decode<Msg>(event.data);
  if (!message) return Rejected{message.rejection()};
  return from_message(*message);
}

double serialised_bytes(const MapUpdate& update) {
  std::size_t bytes = 0;
  for (const auto& fragment : split(update.map)) bytes += encode(to_message(fragment)).size();
  for (const auto& association : update.associations) {
    bytes += encode(to_message(association)).size();
  }
  return static_cast<double>(bytes);
}

/// Scan matching and mapping in sequence. Prints a row for every `maps_in_row` local maps.
class LongRun {
 public:
  explicit LongRun(int maps_in_row) : maps_in_row_(maps_in_row), heap_before_(heap_bytes()) {
    std::puts(
        "| local maps | scan matching (ms per map) | mapping (ms per map) | slowest (ms) | "
        "loop closures | accepted | revised | in memory (kB per map) | serialised (kB per map) |\n"
        "|---|---|---|---|---|---|---|---|---|");
  }

  void add(const LogEventView& event) {
    if (event.channel == channels::kWheelOdometry) {
      if (const auto reading = read<wheel_odometry_t>(event)) matching_.add(*reading);
    } else if (event.channel == channels::kLaserFront) {
      if (const auto scan = read<planar_lidar_t>(event)) add(*scan);
    }
  }

  void finish() {
    if (const auto update = mapping_.finish()) count(*update, 0.0);
    if (in_row_ > 0) print_row();
  }

  [[nodiscard]] const Mapping& mapping() const { return mapping_; }
  [[nodiscard]] int scans() const { return scans_; }

 private:
  void add(const LaserScan& scan) {
    ++scans_;
    const double begin = cpu_s();
    const ScanMatch match = matching_.add_scan(LaserId::kFront, scan);
    const double matched = cpu_s();
    const auto update = mapping_.add(std::string(channels::kLaserFront), scan, match);
    const double mapped = cpu_s() - matched;
    matching_s_ += matched - begin;
    mapping_s_ += mapped;
    if (update) count(*update, mapped);
  }

  void count(const MapUpdate& update, double map_s) {
    ++in_row_;
    slowest_s_ = std::max(slowest_s_, map_s);
    serialised_ += serialised_bytes(update);
    for (const Association& a : update.associations) {
      revised_ += a.action == Association::Action::kRevised ? 1 : 0;
    }
    if (in_row_ == maps_in_row_) print_row();
  }

  void print_row() {
    const auto maps = static_cast<double>(mapping_.local_maps().size());
    const auto& chosen = mapping_.association().hypothesis().chosen;
    const auto accepted =
        std::count_if(chosen.begin(), chosen.end(), [](int c) { return c != Association::kNone; });
    std::printf("| %.0f | %.1f | %.1f | %.0f | %zu | %td | %d | %.1f | %.1f |\n", maps,
                1e3 * matching_s_ / in_row_, 1e3 * mapping_s_ / in_row_, 1e3 * slowest_s_,
                chosen.size(), accepted, revised_, (heap_bytes() - heap_before_) / maps / 1e3,
                serialised_ / maps / 1e3);
    std::fflush(stdout);
    in_row_ = 0;
    matching_s_ = mapping_s_ = slowest_s_ = 0.0;
  }

  int maps_in_row_;
  double heap_before_;
  ScanMatching matching_{ScanMatchingParams{}};
  Mapping mapping_{MappingParams{}};
  int scans_ = 0;
  int in_row_ = 0;
  int revised_ = 0;
  double matching_s_ = 0.0;
  double mapping_s_ = 0.0;
  double slowest_s_ = 0.0;
  double serialised_ = 0.0;
};

/// Poses of all stored scans, in the map frame or, by scan matching alone, in the odom frame.
Trajectory trajectory_of(const Mapping& mapping, bool in_odom) {
  Trajectory trajectory;
  const auto& poses = mapping.association().hypothesis().T_map_local;
  for (const LocalMap& map : mapping.local_maps().load_all()) {
    const Pose2& T = in_odom ? map.T_odom_local : poses[static_cast<std::size_t>(map.id)];
    for (const LocalScan& scan : map.scans) {
      if (!trajectory.empty() && trajectory.back().utime >= scan.scan.utime) continue;
      trajectory.push_back({scan.scan.utime, T * scan.T_local_body});
    }
  }
  return trajectory;
}

void print_error(const Mapping& mapping, const Trajectory& truth) {
  for (const bool in_odom : {true, false}) {
    const PathError error = path_error(trajectory_of(mapping, in_odom), truth);
    std::printf("%s: RMSE %.3f m, largest error %.3f m\n", in_odom ? "scan matching alone" : "map",
                error.rmse_m, error.farthest_m);
  }
  const auto true_pose = [&](int map) {
    return interpolate(truth, mapping.local_maps()[static_cast<std::size_t>(map)].utime);
  };
  int wrong = 0;
  const auto& loop_closures = mapping.association().problem().loop_closures;
  for (std::size_t k = 0; k < loop_closures.size(); ++k) {
    const int chosen = mapping.association().hypothesis().chosen[k];
    if (chosen == Association::kNone) continue;
    const auto& a = loop_closures[k].alternatives[static_cast<std::size_t>(chosen)];
    const auto older = true_pose(a.older_map);
    const auto newer = true_pose(loop_closures[k].newer_map);
    if (!older || !newer) continue;
    const Pose2 error = between(a.T_older_newer, between(*older, *newer));
    wrong += error.translation().norm() > kRightM ? 1 : 0;
  }
  std::printf("loop closures with an error above %.1f m: %d\n", kRightM, wrong);
}

void run(const std::filesystem::path& log, const std::optional<std::filesystem::path>& truth,
         int maps_in_row) {
  const auto begin = std::chrono::steady_clock::now();
  LogFile events(log);
  LongRun run(maps_in_row);
  while (const auto event = events.next()) run.add(*event);
  run.finish();
  const RunCost cost = process_cost();
  std::printf(
      "\n%d scans, %zu local maps: wall time %.1f s, CPU time %.1f s, peak memory %.0f MB, "
      "%d hypotheses\n",
      run.scans(), run.mapping().local_maps().size(), seconds_since(begin), cost.cpu_s,
      cost.peak_memory_mb * 1024.0 * 1024.0 / kMb, run.mapping().association().trials());
  if (truth) print_error(run.mapping(), read_tum(*truth));
}

}  // namespace
}  // namespace adit

int main(int argc, char** argv) try {
  CLI::App app("Measures time and memory of scan matching and mapping on a long log");
  std::filesystem::path log;
  std::optional<std::filesystem::path> truth;
  int maps_in_row = 200;
  app.add_option("LOG", log, "LCM log")->required();
  app.add_option("--truth", truth, "Ground truth trajectory, TUM format");
  app.add_option("--row", maps_in_row, "Local maps in each row")
      ->check(CLI::PositiveNumber)
      ->capture_default_str();
  CLI11_PARSE(app, argc, argv);
  adit::run(log, truth, maps_in_row);
  return 0;
} catch (const std::exception& error) {
  std::cerr << "long_run: " << error.what() << "\n";
  return 2;
}

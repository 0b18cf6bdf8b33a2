// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
// sparse_logs_table [--log NAME] [--turns NAME]: does a map know when it is wrong? Each recording
// with every scan, and each 2nd, 4th and 8th of them, with and without odometry; then one recording
// without odometry with a turn of 30 to 180° cut out between two scans, at ten places. A map is
// right if its error is at most twice that of the dense map at the same times (with or without
// odometry, whichever has the smaller error). Otherwise it must
// report doubtful stretches, and each motion between two scans that differs from the dense map must
// lie within 5 m of one: else the failure is unreported. A rejected log counts as reported.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <functional>
#include <iostream>
#include <optional>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include "common/geometry/pose2.hpp"
#include "tests/eval/mapping/reported_map.hpp"
#include "tests/eval/markdown.hpp"
#include "tests/support/recordings.hpp"
#include "tests/support/scratch_folder.hpp"
#include "tools/carmen/gzip_line_reader.hpp"
#include "tools/eval/relations.hpp"
#include "tools/eval/trajectory.hpp"

namespace adit {
namespace {

struct Recording {
  const char* name;
  const char* log;
  const char* relations;  ///< nullptr: the dense map is compared with
  bool has_odometry;
};

constexpr std::array kRecordings = {
    Recording{"Intel", "intel_raw.log.gz", "intel.relations", true},
    Recording{"CSAIL", "csail_raw.log.gz", "csail.relations", true},
    Recording{"FR079", "fr079_chain.log.gz", "fr079.relations", true},
    Recording{"Acapulco", "acapulco_scans.log.gz", nullptr, false},
    Recording{"Seattle", "seattle_scans.log.gz", nullptr, false}};

constexpr double kRightRatio = 2.0;
constexpr double kWrongMotionM = 0.5;  // of a motion against the dense map
constexpr double kWrongMotionRad = 0.25;

std::filesystem::path recording(const char* name) {
  return test::find_recording(std::string("laser2d/") + name).value_or("");
}

bool is_scan(std::string_view line) {
  return line.starts_with("FLASER") || line.starts_with("ROBOTLASER1");
}

/// Copies the lines of a log but for the scans that are not kept; `keep` has their number.
void write_thinned(const std::filesystem::path& log, const std::filesystem::path& thinned,
                   const std::function<bool(std::size_t)>& keep) {
  GzipLineReader lines(log);
  std::ofstream out(thinned);
  std::size_t scan = 0;
  while (const auto line = lines.next()) {
    if (!is_scan(line->text) || keep(scan++)) out << line->text << "\n";
  }
}

/// The wrong motions of a map: their number, and of those that no stretch within 5 m reports.
struct WrongMotions {
  std::size_t all = 0;
  std::size_t unreported = 0;
};

WrongMotions wrong_motions(const ReportedMap& map, const Trajectory& dense) {
  const Trajectory truth = sampled(dense, map.trajectory);
  const std::vector<double> along = distances(truth);
  WrongMotions wrong;
  for (std::size_t i = 1; i < truth.size(); ++i) {
    const auto from = interpolate(map.trajectory, truth[i - 1].utime);
    const auto to = interpolate(map.trajectory, truth[i].utime);
    const Pose2 error = between(between(truth[i - 1].pose, truth[i].pose), between(*from, *to));
    if (error.translation().norm() < kWrongMotionM && std::abs(error.theta) < kWrongMotionRad) {
      continue;
    }
    ++wrong.all;
    const bool reported = reports(map, truth, along, along[i - 1], along[i]);
    wrong.unreported += reported ? 0U : 1U;
  }
  return wrong;
}

struct Total {
  int maps = 0;
  int right = 0;
  int reported = 0;
  int unreported = 0;
};

void print_row(const std::string& name, const ReportedMap& map, const Trajectory& dense,
               const std::vector<Relation>& relations, Total& total) {
  const double error = error_m(relations, map.trajectory);
  const double dense_error = error_m(relations, sampled(dense, map.trajectory));
  constexpr double kFloorM = 0.05;  // of relations by the dense map itself, which has no error
  const bool right = error <= kRightRatio * std::max(dense_error, kFloorM);
  const WrongMotions wrong = wrong_motions(map, dense);
  // A map that is wrong though each of its motions is nearly right must report any stretch.
  const bool reported = !map.stretches.empty() && wrong.unreported == 0;
  const bool unreported = !right && !reported;
  ++total.maps;
  total.right += right ? 1 : 0;
  total.reported += !right && reported ? 1 : 0;
  total.unreported += unreported ? 1 : 0;
  std::cout << fmt::format("| {} | {:.3f} | {:.3f} | {} | {} | {} | {} | {} |\n", name, error,
                           dense_error, right ? "yes" : "no", map.stretches.size(), wrong.all,
                           wrong.unreported, unreported ? "UNREPORTED" : "")
            << std::flush;
}

/// Maps a log and prints its row. A log of which next to nothing matches is rejected, with a
/// reason.
void print_map(const std::string& name, const std::filesystem::path& log, bool use_odometry,
               const Trajectory& dense, const std::vector<Relation>& relations, Total& total) {
  std::optional<ReportedMap> map;
  try {
    map = map_log(log, use_odometry);
  } catch (const std::runtime_error&) {
    ++total.maps;
    ++total.reported;
    std::cout << fmt::format("| {} | – | – | rejected | – | – | – |  |\n", name) << std::flush;
    return;
  }
  print_row(name, *map, dense, relations, total);
}

/// The ends of a turn by an angle, as indices of poses [first, last].
struct Turn {
  std::size_t first = 0;
  std::size_t last = 0;
};

/// The first turn by `angle_rad` within 3 m of path, from a pose on; nothing if there is none.
std::optional<Turn> find_turn(const Trajectory& path, std::size_t from, double angle_rad) {
  constexpr double kTurnM = 3.0;
  const std::vector<double> along = distances(path);
  for (std::size_t i = from; i < path.size(); ++i) {
    double turned = 0.0;
    for (std::size_t j = i + 1; j < path.size() && along[j] - along[i] < kTurnM; ++j) {
      turned += between(path[j - 1].pose, path[j].pose).theta;
      if (std::abs(turned) >= angle_rad) return Turn{i, j};
    }
  }
  return std::nullopt;
}

void print_turns(const Recording& of, const Trajectory& dense,
                 const std::vector<Relation>& relations, Total& total) {
  constexpr std::size_t kPlaces = 10;
  for (std::size_t k = 0; k < kPlaces; ++k) {
    const double angle = deg_to_rad(30.0 + 150.0 * static_cast<double>(k) / (kPlaces - 1));
    std::optional<Turn> turn = find_turn(dense, dense.size() * (k + 1) / (kPlaces + 2), angle);
    if (!turn) turn = find_turn(dense, 10, angle);
    if (!turn) continue;
    const test::ScratchFolder scratch;
    const auto cut = scratch / "cut.log";
    write_thinned(recording(of.log), cut,
                  [&](std::size_t scan) { return scan <= turn->first || scan >= turn->last; });
    print_map(fmt::format("{} | turn of {:.0f}° cut out | no", of.name, rad_to_deg(angle)), cut,
              false, dense, relations, total);
  }
}

void print_table(const std::string& only, const std::string& turns) {
  print_heading(
      "| log | scans | odometry | error (m) | dense map at these times (m) | right "
      "| reported stretches | wrong motions | of these not reported | unreported failure |");
  Total total;
  for (const Recording& of : kRecordings) {
    if (recording(of.log).empty() || (!only.empty() && only != of.name)) continue;
    Trajectory dense = map_log(recording(of.log), false).trajectory;
    const std::vector<Relation> relations =
        of.relations != nullptr ? read_relations(recording(of.relations)) : relations_of(dense);
    if (of.has_odometry) {
      const Trajectory with_odometry = map_log(recording(of.log), true).trajectory;
      if (error_m(relations, with_odometry) < error_m(relations, dense)) dense = with_odometry;
    }
    for (const std::size_t each : {1U, 2U, 4U, 8U}) {
      const test::ScratchFolder scratch;
      const auto thinned = scratch / "thinned.log";
      write_thinned(recording(of.log), thinned, [&](std::size_t scan) { return scan % each == 0; });
      for (const bool use_odometry : {true, false}) {
        if (use_odometry && !of.has_odometry) continue;
        print_map(fmt::format("{} | 1/{} | {}", of.name, each, use_odometry ? "yes" : "no"),
                  thinned, use_odometry, dense, relations, total);
      }
    }
    if (turns == of.name) print_turns(of, dense, relations, total);
  }
  std::cout << fmt::format("\n{} maps: {} right, {} wrong and reported, {} unreported failures\n",
                           total.maps, total.right, total.reported, total.unreported);
}

}  // namespace
}  // namespace adit

int main(int argc, char** argv) try {
  CLI::App app("Maps of sparse logs, and whether they know when they are wrong, as a table");
  std::string only;
  std::string turns = "CSAIL";
  app.add_option("--log", only, "Only this recording");
  app.add_option("--turns", turns, "Recording from which turns are cut out")->capture_default_str();
  CLI11_PARSE(app, argc, argv);
  adit::print_table(only, turns);
  return EXIT_SUCCESS;
} catch (const std::exception& error) {
  std::cerr << "sparse_logs_table: " << error.what() << "\n";
  return 2;
}

// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
// power_cuts_table WORLD WAYPOINTS: cuts the computer of a robot off at random moments of a drive,
// as a table in Markdown of what it then knew.
#include <algorithm>
#include <cmath>
#include <exception>
#include <filesystem>
#include <iomanip>
#include <iostream>
#include <numbers>
#include <random>
#include <string>

#include <CLI/CLI.hpp>

#include "sim/drive/waypoint_file.hpp"
#include "sim/world/build_world.hpp"
#include "sim/world/world_file.hpp"
#include "tests/support/power_cut_drive.hpp"
#include "tests/support/scratch_folder.hpp"

namespace adit {
namespace {

constexpr double kOnM = 12.0;  // after which it is asked again where the robot believes to be
constexpr double kFoundM = 0.3;
constexpr double kFoundRad = 3.0 / 180.0 * std::numbers::pi;
constexpr double kSigmas = 3.0;  // of what is said, that the error may be

struct Options {
  std::string world;
  std::filesystem::path waypoints;
  int cuts = 20;
  unsigned seed = 1;
  double apart_m = 25.0;  // on average, and 12 m at least
  double skip_m = 0.0;    // of the way, before the first
};

void print(const test::PowerCut& cut) {
  const char* at = cut.in_motion ? "driving" : "sweeping";
  std::cout << "| " << std::setprecision(0) << cut.way_m << " | " << at
            << (cut.torn ? ", torn" : "") << " | " << cut.maps << ", " << cut.maps_lost << " | "
            << cut.scans << ", " << cut.scans_lost << " | " << std::setprecision(2);
  if (cut.found_s) {
    std::cout << *cut.found_s << " | " << cut.error_m << " | " << cut.error_rad * 180.0 / M_PI
              << " | " << cut.sd_m << " | " << cut.sd_rad * 180.0 / M_PI << " | "
              << cut.later_error_m << " | " << cut.later_sd_m << " |\n";
  } else {
    std::cout << "never | | | | | | |\n";
  }
  std::cout.flush();
}

bool is_honest(const test::PowerCut& cut) {
  return cut.found_s && cut.error_m <= std::max(kFoundM, kSigmas * cut.sd_m) &&
         cut.error_rad <= std::max(kFoundRad, kSigmas * cut.sd_rad);
}

int run(const Options& options) {
  const test::ScratchFolder scratch;
  test::PowerCutDrive drive(build_world(find_world(options.world)),
                            read_waypoints(options.waypoints), scratch / "");
  std::mt19937 random(options.seed);
  std::exponential_distribution<double> further(1.0 / std::max(1.0, options.apart_m - kOnM));
  std::cout
      << std::fixed
      << "| at [m] | while | local maps, lost | 3D scans, lost | found after [s] | error [m] | "
         "[°] | said sd [m] | [°] | error 12 m on [m] | said sd [m] |\n"
         "|---|---|---|---|---|---|---|---|---|---|---|\n";
  int found = 0;
  int honest = 0;
  int lost = 0;
  int cuts = 0;
  if (options.skip_m > 0.0 && !drive.drive(options.skip_m)) return 1;
  for (; cuts < options.cuts; ++cuts) {
    if (!drive.drive(further(random))) break;
    if (cuts % 3 == 1) drive.sweep();
    if (cuts % 3 != 0 && !drive.drive(2.0 + 4.0 * static_cast<double>(cuts % 2))) break;
    if (cuts % 5 == 3) drive.sweep(std::uniform_real_distribution<double>(0.5, 8.0)(random));
    test::PowerCut cut =
        drive.cut(cuts % 4 == 2 ? test::DiskAfterCut::kTorn : test::DiskAfterCut::kWhole, random);
    if (!drive.drive(kOnM)) break;
    drive.look_back(cut);
    print(cut);
    found += cut.found_s && cut.error_m <= kFoundM && cut.error_rad <= kFoundRad ? 1 : 0;
    honest += is_honest(cut) ? 1 : 0;
    lost += cut.torn ? 0 : cut.maps_lost + cut.scans_lost;
  }
  std::cout << "\n"
            << cuts << " cuts: found within 0.3 m and 3° " << found << " times, or honestly wide "
            << honest << " times; lost without a torn record: " << lost << "\n";
  return cuts > 0 && honest == cuts && lost == 0 ? 0 : 1;
}

}  // namespace
}  // namespace adit

int main(int argc, char** argv) try {
  adit::Options options;
  CLI::App app{"Cuts the computer of a robot off at random moments of a drive."};
  app.add_option("world", options.world, "name or file")->required();
  app.add_option("waypoints", options.waypoints, "file")->required();
  app.add_option("--cuts", options.cuts);
  app.add_option("--seed", options.seed);
  app.add_option("--apart-m", options.apart_m);
  app.add_option("--skip-m", options.skip_m);
  CLI11_PARSE(app, argc, argv);
  return adit::run(options);
} catch (const std::exception& error) {
  std::cerr << "power_cuts_table: " << error.what() << "\n";
  return 2;
}

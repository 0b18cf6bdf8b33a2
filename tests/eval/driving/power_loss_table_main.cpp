// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
// power_loss_table WORLD WAYPOINTS: cuts the computer of a robot off at random moments of a drive,
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
#include "tests/support/drives/power_loss_drive.hpp"
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
  int power_losses = 20;
  unsigned seed = 1;
  double spacing_m = 25.0;  // on average, and 12 m at least
  double skip_m = 0.0;      // of the way, before the first
};

void print(const test::PowerLoss& loss) {
  const char* at = loss.in_motion ? "driving" : "sweeping";
  std::cout << "| " << std::setprecision(0) << loss.distance_travelled_m << " | " << at
            << (loss.truncated ? ", torn" : "") << " | " << loss.maps << ", " << loss.maps_lost
            << " | " << loss.scans << ", " << loss.scans_lost << " | " << std::setprecision(2);
  if (loss.localized_after_s) {
    std::cout << *loss.localized_after_s << " | " << loss.error_m << " | "
              << loss.error_rad * 180.0 / M_PI << " | " << loss.sd_m << " | "
              << loss.sd_rad * 180.0 / M_PI << " | " << loss.error_after_driving_m << " | "
              << loss.sd_after_driving_m << " |\n";
  } else {
    std::cout << "never | | | | | | |\n";
  }
  std::cout.flush();
}

bool is_consistent(const test::PowerLoss& loss) {
  return loss.localized_after_s && loss.error_m <= std::max(kFoundM, kSigmas * loss.sd_m) &&
         loss.error_rad <= std::max(kFoundRad, kSigmas * loss.sd_rad);
}

int run(const Options& options) {
  const test::ScratchFolder scratch;
  test::PowerLossDrive drive(build_world(find_world(options.world)),
                             read_waypoints(options.waypoints), scratch / "");
  std::mt19937 random(options.seed);
  std::exponential_distribution<double> further(1.0 / std::max(1.0, options.spacing_m - kOnM));
  std::cout
      << std::fixed
      << "| at [m] | while | local maps, lost | 3D scans, lost | found after [s] | error [m] | "
         "[°] | said sd [m] | [°] | error 12 m on [m] | said sd [m] |\n"
         "|---|---|---|---|---|---|---|---|---|---|---|\n";
  int found = 0;
  int consistent = 0;
  int failed = 0;
  int power_losses = 0;
  if (options.skip_m > 0.0 && !drive.drive(options.skip_m)) return 1;
  for (; power_losses < options.power_losses; ++power_losses) {
    if (!drive.drive(further(random))) break;
    if (power_losses % 3 == 1) drive.sweep();
    if (power_losses % 3 != 0 && !drive.drive(2.0 + 4.0 * static_cast<double>(power_losses % 2)))
      break;
    if (power_losses % 5 == 3)
      drive.sweep(std::uniform_real_distribution<double>(0.5, 8.0)(random));
    test::PowerLoss loss =
        drive.lose_power(power_losses % 4 == 2 ? test::DiskAfterPowerLoss::kTruncated
                                               : test::DiskAfterPowerLoss::kIntact,
                         random);
    if (!drive.drive(kOnM)) break;
    drive.evaluate_later(loss);
    print(loss);
    found +=
        loss.localized_after_s && loss.error_m <= kFoundM && loss.error_rad <= kFoundRad ? 1 : 0;
    consistent += is_consistent(loss) ? 1 : 0;
    failed += loss.truncated ? 0 : loss.maps_lost + loss.scans_lost;
  }
  std::cout << "\n"
            << power_losses << " cuts: found within 0.3 m and 3° " << found
            << " times, or honestly wide " << consistent
            << " times; lost without a torn record: " << failed << "\n";
  return power_losses > 0 && consistent == power_losses && failed == 0 ? 0 : 1;
}

}  // namespace
}  // namespace adit

int main(int argc, char** argv) try {
  adit::Options options;
  CLI::App app{"Cuts the computer of a robot off at random moments of a drive."};
  app.add_option("world", options.world, "name or file")->required();
  app.add_option("waypoints", options.waypoints, "file")->required();
  app.add_option("--cuts", options.power_losses);
  app.add_option("--seed", options.seed);
  app.add_option("--apart-m", options.spacing_m);
  app.add_option("--skip-m", options.skip_m);
  CLI11_PARSE(app, argc, argv);
  return adit::run(options);
} catch (const std::exception& error) {
  std::cerr << "power_loss_table: " << error.what() << "\n";
  return 2;
}

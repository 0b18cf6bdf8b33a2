// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
// power_loss_table WORLD WAYPOINTS: power losses of the on-board computer at random times of a
// drive, as a table in Markdown of the data and the pose recovered afterwards. Succeeds if every
// pose error is consistent with its covariance and no complete record is lost.
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

constexpr double kSecondCheckM = 12.0;  // distance travelled before the pose is evaluated again
constexpr double kErrorMaxM = 0.3;
constexpr double kErrorMaxRad = 3.0 / 180.0 * std::numbers::pi;
constexpr double kSigmas = 3.0;  // largest consistent error, in estimated standard deviations

struct Options {
  std::string world;
  std::filesystem::path waypoints;
  int power_losses = 20;
  unsigned seed = 1;
  double spacing_m = 25.0;  // mean distance between power losses; at least 12 m
  double skip_m = 0.0;      // distance travelled before the first power loss
};

void print(const test::PowerLoss& loss) {
  const char* at = loss.in_motion ? "driving" : "sweeping";
  std::cout << "| " << std::setprecision(0) << loss.distance_travelled_m << " | " << at
            << (loss.truncated ? ", truncated" : "") << " | " << loss.maps << ", " << loss.maps_lost
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
  return loss.localized_after_s && loss.error_m <= std::max(kErrorMaxM, kSigmas * loss.sd_m) &&
         loss.error_rad <= std::max(kErrorMaxRad, kSigmas * loss.sd_rad);
}

int run(const Options& options) {
  const test::ScratchFolder scratch;
  test::PowerLossDrive drive(build_world(find_world(options.world)),
                             read_waypoints(options.waypoints), scratch / "");
  std::mt19937 random(options.seed);
  std::exponential_distribution<double> spacing(1.0 /
                                                std::max(1.0, options.spacing_m - kSecondCheckM));
  std::cout
      << std::fixed
      << "| at [m] | state | local maps, lost | 3D scans, lost | localized after [s] | error [m] | "
         "[°] | sd [m] | [°] | error after 12 m [m] | sd after 12 m [m] |\n"
         "|---|---|---|---|---|---|---|---|---|---|---|\n";
  int localized = 0;
  int consistent = 0;
  int lost = 0;
  int power_losses = 0;
  if (options.skip_m > 0.0 && !drive.drive(options.skip_m)) return 1;
  for (; power_losses < options.power_losses; ++power_losses) {
    if (!drive.drive(spacing(random))) break;
    if (power_losses % 3 == 1) drive.sweep();
    if (power_losses % 3 != 0 && !drive.drive(2.0 + 4.0 * static_cast<double>(power_losses % 2)))
      break;
    if (power_losses % 5 == 3)
      drive.sweep(std::uniform_real_distribution<double>(0.5, 8.0)(random));
    test::PowerLoss loss =
        drive.lose_power(power_losses % 4 == 2 ? test::DiskAfterPowerLoss::kTruncated
                                               : test::DiskAfterPowerLoss::kIntact,
                         random);
    if (!drive.drive(kSecondCheckM)) break;
    drive.evaluate_later(loss);
    print(loss);
    localized +=
        loss.localized_after_s && loss.error_m <= kErrorMaxM && loss.error_rad <= kErrorMaxRad ? 1
                                                                                               : 0;
    consistent += is_consistent(loss) ? 1 : 0;
    lost += loss.truncated ? 0 : loss.maps_lost + loss.scans_lost;
  }
  std::cout << "\n"
            << power_losses << " power losses: " << localized << " localized within 0.3 m and 3°, "
            << consistent << " within that or 3 sd; lost without a truncated record: " << lost
            << "\n";
  return power_losses > 0 && consistent == power_losses && lost == 0 ? 0 : 1;
}

}  // namespace
}  // namespace adit

int main(int argc, char** argv) try {
  adit::Options options;
  CLI::App app{"Simulates power losses of the on-board computer at random times of a drive"};
  app.add_option("world", options.world, "World name or file")->required();
  app.add_option("waypoints", options.waypoints, "Waypoint file")->required();
  app.add_option("--losses", options.power_losses, "Number of power losses");
  app.add_option("--seed", options.seed, "Seed of their positions");
  app.add_option("--apart-m", options.spacing_m, "Mean distance between them");
  app.add_option("--skip-m", options.skip_m, "Distance before the first");
  CLI11_PARSE(app, argc, argv);
  return adit::run(options);
} catch (const std::exception& error) {
  std::cerr << "power_loss_table: " << error.what() << "\n";
  return 2;
}

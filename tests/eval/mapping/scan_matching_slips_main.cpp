// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
// scan_matching_slips_table LOGS..: matches the recorded scans of missions again, and compares the
// displacements over 2 s with the ground truth of the simulator, as a table in Markdown.
#include <algorithm>
#include <cmath>
#include <exception>
#include <filesystem>
#include <iostream>
#include <map>
#include <string>
#include <vector>

#include <CLI/CLI.hpp>

#include "common/bus/channels.hpp"
#include "common/bus/log/lcm_log.hpp"
#include "common/bus/memory_bus.hpp"
#include "common/bus/typed_messages.hpp"
#include "common/files/mapped_file.hpp"
#include "common/messages/mapping/odometry.hpp"
#include "common/messages/mapping/terrain.hpp"
#include "common/messages/sensing.hpp"
#include "procs/scan_matching/scan_matching.hpp"
#include "tests/eval/markdown.hpp"
#include "tools/eval/trajectory.hpp"
#include "tools/report/records/log_info.hpp"

namespace adit {
namespace {

constexpr std::int64_t kWindowUs = 2'000'000;
constexpr double kSlipM = 0.1;

/// Errors of the displacements over consecutive windows.
struct Slips {
  std::size_t windows = 0;  ///< in which the body moves
  std::size_t slips = 0;    ///< of them, with an error above kSlipM
  double squares_m2 = 0.0;
  double largest_m = 0.0;
  double largest_rad = 0.0;
  double largest_z_m = 0.0;

  [[nodiscard]] std::string text() const {
    return format("%zu | %zu | %.3f | %.2f | %.3f | %.2f", windows, slips,
                  std::sqrt(squares_m2 / static_cast<double>(std::max<std::size_t>(1, windows))),
                  largest_m, largest_rad, largest_z_m);
  }
};

/// Matches the scans of a log again.
class Rematched {
 public:
  explicit Rematched(const std::filesystem::path& log) : log_(log), matching_(params_of(log)) {
    const auto all = Delivery::queued(500);
    subscribe<wheel_odometry_t>(bus_, channels::kWheelOdometry, all,
                                [this](const WheelOdometry& wheels) { matching_.add(wheels); });
    subscribe<imu_t>(bus_, channels::kImu, all,
                     [this](const ImuReading& reading) { matching_.add(reading); });
    subscribe<terrain_t>(bus_, channels::kTerrain, Delivery::queued(TerrainFragment::kFragmentsMax),
                         [this](const TerrainFragment& fragment) { add(fragment); });
    subscribe<pose_t>(bus_, channels::kPose, all, [this](const StampedPose& pose) {
      recorded_.push_back({pose.utime, pose.T_odom_body, pose.z_m});
    });
    subscribe<pose_t>(bus_, channels::kTruth, all, [this](const StampedPose& pose) {
      truth_.push_back({pose.utime, pose.T_odom_body, pose.z_m});
    });
    subscribe_laser(LaserId::kFront, channels::kLaserFront, channels::kTiltFront);
    subscribe_laser(LaserId::kRear, channels::kLaserRear, channels::kTiltRear);
  }

  Slips score(bool print_slips) {
    play();
    Slips slips;
    if (matched_.empty()) return slips;
    for (std::int64_t from = matched_.front().utime; from + kWindowUs <= matched_.back().utime;
         from += kWindowUs) {
      add_window(from, print_slips, slips);
    }
    return slips;
  }

 private:
  static ScanMatchingParams params_of(const std::filesystem::path& log) {
    ScanMatchingParams params;
    params.lasers = read_log_info({log}).lasers;
    return params;
  }

  void subscribe_laser(LaserId laser, std::string_view scans, std::string_view tilts) {
    subscribe<tilt_t>(bus_, tilts, Delivery::queued(500),
                      [this, laser](const TiltReading& tilt) { tilt_[laser] = tilt; });
    subscribe<planar_lidar_t>(bus_, scans, Delivery::queued(100),
                              [this, laser](const LaserScan& scan) { match(laser, scan); });
  }

  void match(LaserId laser, const LaserScan& scan) {
    const auto tilt = tilt_.find(laser);
    if (tilt == tilt_.end() || !ScanMatchingParams{}.level_tilt.is_level(tilt->second)) return;
    const ScanMatch match = matching_.add_scan(laser, scan);
    if (match.status == ScanMatch::Status::kRejected) return;
    matched_.push_back({match.utime, match.T_odom_body, match.z_m});
  }

  /// The map is in the recorded odom frame, which drifts otherwise.
  void add(const TerrainFragment& fragment) {
    auto terrain = terrain_.add(fragment);
    if (!terrain) return;
    const auto recorded = interpolate(recorded_, terrain->utime);
    const auto matched = interpolate(matched_, terrain->utime);
    if (!recorded || !matched) return;
    terrain->T_odom_level = *matched * between(*recorded, terrain->T_odom_level);
    matching_.add(std::move(*terrain));
  }

  void play() {
    const MappedFile file(log_);
    LogParser parser(file.bytes());
    while (const auto event = parser.next()) {
      for (const auto channel : {channels::kLaserFront, channels::kLaserRear, channels::kTiltFront,
                                 channels::kTiltRear, channels::kWheelOdometry, channels::kImu,
                                 channels::kTerrain, channels::kPose, channels::kTruth}) {
        if (event->channel == channel) bus_.inject(event->utime, event->channel, event->data);
      }
    }
  }

  void add_window(std::int64_t from, bool print, Slips& slips) const {
    const auto true_from = interpolate_in_space(truth_, from);
    const auto true_to = interpolate_in_space(truth_, from + kWindowUs);
    const auto begin = interpolate_in_space(matched_, from);
    const auto end = interpolate_in_space(matched_, from + kWindowUs);
    if (!true_from || !true_to || !begin || !end) return;
    const Pose2 moved = between(true_from->pose, true_to->pose);
    if (moved.translation().norm() < 0.05 && std::abs(moved.theta) < 0.05) return;
    const Pose2 error = between(moved, between(begin->pose, end->pose));
    const double error_m = error.translation().norm();
    const double z_m = (end->z_m - begin->z_m) - (true_to->z_m - true_from->z_m);
    ++slips.windows;
    slips.slips += error_m > kSlipM ? 1U : 0U;
    slips.squares_m2 += error_m * error_m;
    slips.largest_m = std::max(slips.largest_m, error_m);
    slips.largest_rad = std::max(slips.largest_rad, std::abs(error.theta));
    slips.largest_z_m = std::max(slips.largest_z_m, std::abs(z_m));
    if (!print || error_m <= kSlipM) return;
    std::cerr << format("%s: %.0f s, at %.1f %.1f: %.2f %.2f m, %.3f rad\n", log_.c_str(),
                        1e-6 * static_cast<double>(from - matched_.front().utime),
                        true_from->pose.x, true_from->pose.y, error.x, error.y, error.theta);
  }

  std::filesystem::path log_;
  MemoryBus bus_;
  ScanMatching matching_;
  TerrainReassembler terrain_;
  std::map<LaserId, TiltReading> tilt_;
  Trajectory recorded_;
  Trajectory matched_;
  Trajectory truth_;
};

void print_table(const std::vector<std::filesystem::path>& logs, bool print_slips) {
  print_heading(
      "| mission | displacements over 2 s | error above 0.1 m | RMSE (m) | largest (m) | largest "
      "(rad) | largest in height (m) |");
  for (const std::filesystem::path& log : logs) {
    std::cout << "| " << log.parent_path().filename().string() << " | "
              << Rematched(log).score(print_slips).text() << " |\n"
              << std::flush;
  }
}

}  // namespace
}  // namespace adit

int main(int argc, char** argv) try {
  CLI::App app(
      "Compares the displacements of scan matching with the truth, as a table in Markdown");
  std::vector<std::filesystem::path> logs;
  bool print_slips = false;
  app.add_option("LOGS", logs, "Logs of simulated missions")->required();
  app.add_flag("--slips", print_slips, "Print each error above 0.1 m");
  CLI11_PARSE(app, argc, argv);
  adit::print_table(logs, print_slips);
  return 0;
} catch (const std::exception& error) {
  std::cerr << "scan_matching_slips_table: " << error.what() << "\n";
  return 2;
}

// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
// emulated_robot SIM_LCM_URL FOLDER
//
// The devices of the robot of deploy/config/skid_steered.yaml in the world of a simulator that runs
// in real time: emulators of a UTM-30LX by TCP, and of a base, a servo and an IMU on
// pseudo-terminals, FOLDER/base, servo and imu. They measure what the simulator says on its own
// bus, and what they are told moves the simulated robot. FOLDER/laser contains the address of the
// laser, once the simulator runs. Ends with SIGTERM and prints what was not right.
#include <atomic>
#include <csignal>
#include <cstdint>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <numbers>
#include <string>
#include <thread>

#include <fmt/format.h>

#include "tests/live/drivers/simulated_robot.hpp"
#include "tests/support/devices/base_emulator.hpp"
#include "tests/support/devices/imu_emulator.hpp"
#include "tests/support/devices/servo_emulator.hpp"
#include "tests/support/lasers/pty_line.hpp"
#include "tests/support/lasers/scip_emulator.hpp"
#include "tests/support/lasers/tcp_laser.hpp"

namespace adit {
namespace {

constexpr double kTrackM = 0.54;
constexpr double kTicksPerM = 5000.0;
constexpr double kTicksPerRad = 4096.0 / (2.0 * std::numbers::pi);
constexpr double kLevelTicks = 2048.0;
constexpr std::int64_t kScanPeriodUs = 25'000;
constexpr std::int64_t kCommandPeriodUs = 20'000;
constexpr std::int64_t kScanOffMaxUs = 100;

std::atomic<bool> ends{false};

/// The mirror turns freely from power on: at this time, or a little later, so that scans begin when
/// those of the simulator do.
std::int64_t power_on_in_phase(std::int64_t utime, std::int64_t scan_utime) {
  const std::int64_t off_us = (scan_utime - utime - ScipEmulator::kFirstScanUs) % kScanPeriodUs;
  return utime + (off_us < 0 ? off_us + kScanPeriodUs : off_us);
}

class EmulatedRobot {
 public:
  EmulatedRobot(const std::string& sim_url, const std::filesystem::path& folder)
      : robot_(sim_url, kTrackM),
        base_({.moved_ticks = [this](std::int64_t utime) { return ticks(utime); }}),
        servo_({.moved_position = [this](std::int64_t utime) { return position(utime); }}),
        imu_({}, [this](int /*number*/) { return motion(); }),
        laser_({.has_baud = false}, [this](int scan, int step) { return distance_mm(scan, step); }),
        base_line_(folder / "base", base_),
        servo_line_(folder / "servo", servo_),
        imu_line_(folder / "imu", imu_),
        laser_line_(laser_),
        address_file_(folder / "laser") {}

  void step() {
    robot_.step();
    const auto now = robot_.now();
    if (!now) return;
    if (!is_on_) power_on(*now);
    base_line_.step(*now);
    servo_line_.step(*now);
    imu_line_.step(*now);
    laser_line_.step(*now);
    if (*now < next_command_us_) return;
    next_command_us_ = *now + kCommandPeriodUs;
    command();
  }

  void print() const {
    fmt::print("scans {}, of them without one of the simulator {}; drive commands {}\n", scans_,
               missing_, base_.drives());
    fmt::print("{:.2f} m from the start by the truth, after {:.1f} m\n", robot_.true_distance_m(),
               robot_.true_travel_m());
  }

 private:
  void power_on(std::int64_t now) {
    is_on_ = true;
    base_.power_on(now);
    servo_.power_on(now);
    imu_.power_on(now);
    laser_.power_on(power_on_in_phase(now, robot_.scan(now)->utime));
    std::ofstream(address_file_) << laser_line_.address() << "\n";
  }

  void command() {
    const auto targets = base_.targets_ticks_s();
    const bool stands = base_.is_expired() || base_.brakes();
    robot_.drive(stands ? 0.0 : targets[0] / kTicksPerM, stands ? 0.0 : targets[1] / kTicksPerM,
                 base_.brakes());
    if (servo_.torque())
      robot_.tilt((servo_.goal() - kLevelTicks) / kTicksPerRad,
                  servo_.rate_max_ticks_s() / kTicksPerRad);
  }

  [[nodiscard]] std::array<double, 2> ticks(std::int64_t utime) const {
    const auto travel_m = robot_.travel_m(utime);
    return {travel_m[0] * kTicksPerM, travel_m[1] * kTicksPerM};
  }
  [[nodiscard]] double position(std::int64_t utime) const {
    return kLevelTicks + robot_.tilt_rad(utime) * kTicksPerRad;
  }
  /// The unit is mounted upside down: y to the right, z downwards.
  [[nodiscard]] std::array<double, 6> motion() const {
    const auto m = robot_.motion(imu_.starts().back());
    return {m[0], -m[1], -m[2], m[3], -m[4], -m[5]};
  }

  [[nodiscard]] std::uint32_t distance_mm(int scan, int step) {
    if (step == 0) {
      const std::int64_t utime = laser_.scan_start(scan);
      seen_ = robot_.scan(utime);
      ++scans_;
      if (std::abs(seen_->utime - utime) > kScanOffMaxUs) ++missing_;
    }
    return static_cast<std::uint32_t>(
        std::lround(1e3F * seen_->ranges_m.at(static_cast<std::size_t>(step))));
  }

  SimulatedRobot robot_;
  BaseEmulator base_;
  ServoEmulator servo_;
  ImuEmulator imu_;
  ScipEmulator laser_;
  PtyLaser<BaseEmulator> base_line_;
  PtyLaser<ServoEmulator> servo_line_;
  PtyLaser<ImuEmulator> imu_line_;
  TcpLaser<ScipEmulator> laser_line_;
  std::filesystem::path address_file_;
  const LaserScan* seen_ = nullptr;
  bool is_on_ = false;
  std::int64_t next_command_us_ = 0;
  int scans_ = 0;
  int missing_ = 0;
};

}  // namespace
}  // namespace adit

int main(int argc, char** argv) {
  if (argc != 3) {
    std::cerr << "usage: emulated_robot SIM_LCM_URL FOLDER\n";
    return 2;
  }
  std::signal(SIGTERM, [](int) { adit::ends = true; });
  try {
    adit::EmulatedRobot robot(argv[1], argv[2]);
    while (!adit::ends) {
      robot.step();
      std::this_thread::sleep_for(std::chrono::milliseconds(1));
    }
    robot.print();
  } catch (const std::exception& error) {
    std::cerr << "emulated_robot: " << error.what() << "\n";
    return 1;
  }
  return 0;
}

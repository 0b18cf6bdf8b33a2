// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
// emulated_robot SIM_LCM_URL FOLDER skid_steered|two_sicks|spinning_lidar
//
// The devices of a robot in the world of a simulator that runs in real time: emulators of lasers,
// and of a base, servos and an IMU on pseudo-terminals in FOLDER. They measure what the simulator
// says on its own bus, and what they are told moves the simulated robot. FOLDER/ready exists once
// they are on. Ends with SIGTERM and prints what was not right.
//
// skid_steered: deploy/config/skid_steered.yaml with a UTM-30LX by TCP, whose address is in
// FOLDER/laser_front, and servo_front. two_sicks: deploy/config/robot.yaml on a skid-steered base,
// with two LMS-200 on laser_front and laser_rear, servo_front and servo_rear. spinning_lidar:
// deploy/config/spinning_lidar.yaml with a VLP-16 by UDP to port 2368. All: base, imu.
#include <array>
#include <atomic>
#include <chrono>
#include <csignal>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <memory>
#include <numbers>
#include <stdexcept>
#include <string>
#include <thread>
#include <vector>

#include <fmt/format.h>

#include "tests/live/drivers/emulated_laser.hpp"
#include "tests/live/drivers/emulated_velodyne.hpp"
#include "tests/live/drivers/simulated_robot.hpp"
#include "tests/support/devices/base_emulator.hpp"
#include "tests/support/devices/imu_emulator.hpp"
#include "tests/support/devices/servo_emulator.hpp"
#include "tests/support/lasers/pty_line.hpp"

namespace adit {
namespace {

constexpr double kTicksPerM = 5000.0;
constexpr double kTicksPerRad = 4096.0 / (2.0 * std::numbers::pi);
constexpr double kLevelTicks = 2048.0;
constexpr std::int64_t kCommandPeriodUs = 20'000;

std::atomic<bool> ends{false};

RobotSensors sensors_of(const std::string& robot) {
  if (robot == "skid_steered") return {0.54, 1, false};
  if (robot == "two_sicks") return {0.95, 2, false};
  if (robot == "spinning_lidar") return {0.44, 0, true};
  throw std::invalid_argument("unknown robot " + robot);
}

const char* name_of(LaserId laser) { return laser == LaserId::kFront ? "front" : "rear"; }

/// A servo on a pseudo-terminal, which tilts a laser of the simulated robot.
class EmulatedServo {
 public:
  EmulatedServo(SimulatedRobot& robot, LaserId id, const std::filesystem::path& link)
      : robot_(robot),
        id_(id),
        servo_({.moved_position =
                    [this](std::int64_t utime) {
                      return kLevelTicks + robot_.tilt_rad(id_, utime) * kTicksPerRad;
                    }}),
        line_(link, servo_) {}

  void power_on(std::int64_t now) { servo_.power_on(now); }
  void step(std::int64_t now) { line_.step(now); }
  void command() {
    if (servo_.torque())
      robot_.tilt(id_, (servo_.goal() - kLevelTicks) / kTicksPerRad,
                  servo_.rate_max_ticks_s() / kTicksPerRad);
  }

 private:
  SimulatedRobot& robot_;
  LaserId id_;
  ServoEmulator servo_;
  PtyLaser<ServoEmulator> line_;
};

class EmulatedRobot {
 public:
  EmulatedRobot(const std::string& sim_url, const std::filesystem::path& folder,
                const RobotSensors& sensors)
      : robot_(sim_url, sensors),
        base_({.moved_ticks = [this](std::int64_t utime) { return ticks(utime); }}),
        imu_({}, [this](int /*number*/) { return motion(); }),
        base_line_(folder / "base", base_),
        imu_line_(folder / "imu", imu_),
        ready_file_(folder / "ready") {
    if (sensors.has_lidar) lasers_.push_back(std::make_unique<EmulatedVelodyne>(robot_));
    for (std::size_t i = 0; i < sensors.tilting_lasers; ++i) {
      const auto id = static_cast<LaserId>(i);
      servos_.push_back(std::make_unique<EmulatedServo>(
          robot_, id, folder / fmt::format("servo_{}", name_of(id))));
      const std::filesystem::path laser = folder / fmt::format("laser_{}", name_of(id));
      if (sensors.tilting_lasers == 2) {
        lasers_.push_back(std::make_unique<EmulatedSick>(robot_, id, laser));
      } else {
        lasers_.push_back(std::make_unique<EmulatedHokuyo>(robot_, id, laser));
      }
    }
  }

  void step() {
    robot_.step();
    const auto now = robot_.now();
    if (!now) return;
    if (!is_on_) power_on(*now);
    base_line_.step(*now);
    imu_line_.step(*now);
    for (const auto& servo : servos_) servo->step(*now);
    for (const auto& laser : lasers_) laser->step(*now);
    if (*now < next_command_us_) return;
    next_command_us_ = *now + kCommandPeriodUs;
    command();
  }

  void print() const {
    int scans = 0;
    int missing = 0;
    for (const auto& laser : lasers_) {
      scans += laser->scans();
      missing += laser->missing();
    }
    fmt::print("scans {}, of them without one of the simulator {}; drive commands {}\n", scans,
               missing, base_.drives());
    fmt::print("{:.2f} m from the start by the truth, after {:.1f} m\n", robot_.true_distance_m(),
               robot_.true_travel_m());
  }

 private:
  void power_on(std::int64_t now) {
    is_on_ = true;
    base_.power_on(now);
    imu_.power_on(now);
    for (const auto& servo : servos_) servo->power_on(now);
    for (const auto& laser : lasers_) laser->power_on(now);
    std::ofstream(ready_file_) << "ready\n";
  }

  void command() {
    const auto targets = base_.targets_ticks_s();
    const bool stands = base_.is_expired() || base_.brakes();
    robot_.drive(stands ? 0.0 : targets[0] / kTicksPerM, stands ? 0.0 : targets[1] / kTicksPerM,
                 base_.brakes());
    for (const auto& servo : servos_) servo->command();
  }

  [[nodiscard]] std::array<double, 2> ticks(std::int64_t utime) const {
    const auto travel_m = robot_.travel_m(utime);
    return {travel_m[0] * kTicksPerM, travel_m[1] * kTicksPerM};
  }
  /// The unit is mounted upside down: y to the right, z downwards.
  [[nodiscard]] std::array<double, 6> motion() const {
    const auto m = robot_.motion(imu_.starts().back());
    return {m[0], -m[1], -m[2], m[3], -m[4], -m[5]};
  }

  SimulatedRobot robot_;
  BaseEmulator base_;
  ImuEmulator imu_;
  PtyLaser<BaseEmulator> base_line_;
  PtyLaser<ImuEmulator> imu_line_;
  std::vector<std::unique_ptr<EmulatedServo>> servos_;
  std::vector<std::unique_ptr<EmulatedLaser>> lasers_;
  std::filesystem::path ready_file_;
  bool is_on_ = false;
  std::int64_t next_command_us_ = 0;
};

}  // namespace
}  // namespace adit

int main(int argc, char** argv) {
  if (argc != 4) {
    std::cerr << "usage: emulated_robot SIM_LCM_URL FOLDER skid_steered|two_sicks|spinning_lidar\n";
    return 2;
  }
  std::signal(SIGTERM, [](int) { adit::ends = true; });
  try {
    adit::EmulatedRobot robot(argv[1], argv[2], adit::sensors_of(argv[3]));
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

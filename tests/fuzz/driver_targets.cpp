// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
// Fuzz targets for what devices send: whole conversations, from the first answer to readings.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <functional>
#include <iostream>
#include <memory>
#include <span>
#include <string_view>
#include <vector>

#include "drivers/base_serial/base_serial.hpp"
#include "drivers/imu_vectornav/vectornav.hpp"
#include "drivers/scip/scip.hpp"
#include "drivers/sick_lms2xx/sick_lms2xx.hpp"
#include "drivers/tilt/servo.hpp"
#include "drivers/velodyne/velodyne.hpp"

#include "tests/fuzz/targets.hpp"
#include "tests/support/devices/base_emulator.hpp"
#include "tests/support/devices/imu_emulator.hpp"
#include "tests/support/devices/servo_emulator.hpp"
#include "tests/support/lasers/lms_emulator.hpp"
#include "tests/support/lasers/scip_emulator.hpp"
#include "tests/support/lasers/vlp16_emulator.hpp"

namespace adit::fuzz {
namespace {

constexpr std::int64_t kBeginUs = 100'000'000;
constexpr std::int64_t kTurnUs = 20'000;

/// All that a device sends to its driver in two seconds. `obey` lets the driver obey an order at a
/// time.
template <class Device, class Emulator>
Bytes conversation(
    Device& device, Emulator& laser,
    const std::function<void(Device&, std::int64_t)>& obey = [](Device&, std::int64_t) {}) {
  Bytes sent;
  std::size_t enough = 3000;
  int baud = 0;
  device.start(kBeginUs);
  for (std::int64_t now_us = kBeginUs; now_us < kBeginUs + 2'000'000; now_us += 1000) {
    for (const PortRequest& request : device.take_requests()) {
      if (request.baud) baud = *request.baud;
      laser.receive(request.bytes, baud, now_us);
    }
    Bytes bytes;
    for (const auto& timed : laser.advance(now_us, baud)) bytes.push_back(timed.byte);
    sent.insert(sent.end(), bytes.begin(), bytes.end());
    device.receive(bytes, now_us);
    if (now_us % kTurnUs == 0) {
      obey(device, now_us);
      device.tick(now_us);
    }
    if (!device.is_streaming()) enough = std::max(enough, sent.size() + 1000);
    if (sent.size() > enough) break;
  }
  return sent;
}

[[noreturn]] void fail(const char* what) {
  std::cerr << what << "\n";
  std::abort();
}

/// Gives a new driver these bytes in reads of this number. Returns the reason for rejection: no
/// reading was found. `utime_of` checks a reading and returns its time.
template <class Reading>
std::string_view replay(ReadingDevice<Reading>& device, std::span<const std::uint8_t> bytes,
                        std::size_t read_bytes,
                        const std::function<std::int64_t(const Reading&)>& utime_of) {
  std::int64_t now_us = kBeginUs;
  bool found = false;
  std::int64_t last_us = 0;
  device.start(now_us);
  for (std::size_t i = 0; i < bytes.size(); i += read_bytes) {
    now_us += kTurnUs;
    device.take_requests();
    for (const Reading& reading :
         device.receive(bytes.subspan(i, std::min(read_bytes, bytes.size() - i)), now_us)) {
      last_us = utime_of(reading);
      found = true;
    }
    device.tick(now_us);
  }
  if (std::abs(last_us - kBeginUs) > 1'000'000'000 && found) {
    fail("a reading that was measured minutes before or behind its arrival");
  }
  for (int i = 0; i < 50; ++i) device.tick(now_us += 1'000'000);  // all timeouts
  return found ? "" : "no reading";
}

/// Scans must have the beams of the laser.
std::string_view replay_laser(LaserDevice& device, std::span<const std::uint8_t> bytes,
                              std::size_t beams_max) {
  constexpr std::size_t kReadBytes = 400;
  return replay<LaserScan>(device, bytes, kReadBytes, [beams_max](const LaserScan& scan) {
    if (scan.ranges_m.empty() || scan.ranges_m.size() > beams_max ||
        !std::isfinite(scan.angle_min_rad) || !(scan.angle_step_rad > 0.0)) {
      fail("a scan that no laser measures");
    }
    return scan.utime;
  });
}

SickLms2xxParams lms_params() {
  SickLms2xxParams params;
  params.laser.baud = 500000;
  params.laser.unit = "mm";  // so that the configuration is written
  params.lasers.front.range_max_m = 8.0;
  return params;
}

ScipParams scip_params() {
  ScipParams params;
  params.device = "tcp://laser:10940";
  params.angle_min_deg = -60.0;
  params.angle_max_deg = 60.0;
  return params;
}

Target lms_target() {
  LmsEmulator laser({}, [](int scan, int beam) {
    return static_cast<std::uint16_t>(8000 + (scan + beam) % 192);
  });
  laser.already_streams(kBeginUs - 1'000'000, 500000);
  SickLms2xx device(lms_params(), LaserId::kFront);
  return {"sick_lms2xx", {conversation(device, laser)}, [](std::span<const std::uint8_t> bytes) {
            SickLms2xx fuzzed(lms_params(), LaserId::kFront);
            return replay_laser(fuzzed, bytes, 181);
          }};
}

Target scip_target() {
  ScipEmulator laser({.has_baud = false}, [](int scan, int step) {
    return static_cast<std::uint32_t>(scan + step) % 70000U;
  });
  laser.already_streams(kBeginUs - 1'000'000, 0);
  Scip device(scip_params(), LaserId::kFront);
  return {"scip", {conversation(device, laser)}, [](std::span<const std::uint8_t> bytes) {
            Scip fuzzed(scip_params(), LaserId::kFront);
            return replay_laser(fuzzed, bytes, 100'001);
          }};
}

Target base_target() {
  BaseEmulator base({});
  base.already_streams(kBeginUs - 1'000'000);
  BaseSerial device({});
  const auto obey = [](BaseSerial& driven, std::int64_t now_us) {
    driven.obey(DriveCommand{now_us, 0.5, 0.3}, now_us, now_us);
  };
  return {"base_serial",
          {conversation<BaseSerial, BaseEmulator>(device, base, obey)},
          [](std::span<const std::uint8_t> bytes) {
            constexpr std::size_t kReadBytes = 30;
            BaseSerial fuzzed({});
            return replay<BaseReading>(fuzzed, bytes, kReadBytes, [](const BaseReading& reading) {
              const auto& pose = reading.odometry.T_wheel_body;
              const auto& state = reading.state;
              if (!std::isfinite(pose.x) || !std::isfinite(pose.y) || !std::isfinite(pose.theta) ||
                  !std::isfinite(state.speed_m_s) || !std::isfinite(state.curvature_1_m) ||
                  !(state.battery_share >= 0.0 && state.battery_share <= 1.0) ||
                  std::hypot(pose.x, pose.y) > 100.0) {
                fail("a state that no base is in");
              }
              return reading.odometry.utime;
            });
          }};
}

/// Each read has an answer or a part of one.
Target tilt_target() {
  ServoEmulator servo({.line_has_time = false});
  servo.already_holds(kBeginUs - 1'000'000, 2000);
  TiltServo device({});
  return {"tilt", {conversation(device, servo)}, [](std::span<const std::uint8_t> bytes) {
            constexpr std::size_t kReadBytes = 27;
            TiltServo fuzzed({});
            fuzzed.command({kBeginUs, 0.3, 0.5});
            return replay<TiltReading>(fuzzed, bytes, kReadBytes, [](const TiltReading& reading) {
              if (!std::isfinite(reading.angle_rad) || !std::isfinite(reading.rate_rad_s)) {
                fail("an angle that is not finite");
              }
              return reading.utime;
            });
          }};
}

Target imu_target() {
  ImuEmulator unit({}, [](int number) {
    return std::array<double, 6>{0.1, 0.2, -9.8, 1e-5 * number, 0.0, 0.3};
  });
  unit.already_streams(kBeginUs - 1'000'000, 230400);
  VectorNav device({});
  return {
      "imu_vectornav", {conversation(device, unit)}, [](std::span<const std::uint8_t> bytes) {
        constexpr std::size_t kReadBytes = 224;
        VectorNav fuzzed({});
        return replay<ImuReading>(fuzzed, bytes, kReadBytes, [](const ImuReading& reading) {
          if (!reading.angular_velocity.allFinite() || !reading.linear_acceleration.allFinite()) {
            fail("a reading that is not finite");
          }
          return reading.utime;
        });
      }};
}

VelodyneParams velodyne_params() {
  VelodyneParams params;
  params.lasers.count = 1;
  params.lasers.lidar = {true, 0.2, 90};
  return params;
}

/// The packets of somewhat more than a turn, one behind the other.
Bytes packets_of_a_turn() {
  Vlp16Emulator lidar({.rpm = 1200.0, .return_mode = 0x39},
                      [](double x, double y, double z) { return 3.0 + x + y * z; });
  lidar.power_on(kBeginUs - 200'000);
  Bytes sent;
  for (const auto& packet : lidar.advance(kBeginUs + 110'000)) {
    sent.insert(sent.end(), packet.bytes.begin(), packet.bytes.end());
  }
  return sent;
}

/// Divides the bytes into datagrams. Returns the reason for rejection: no scan was found.
std::string_view replay_datagrams(std::span<const std::uint8_t> bytes) {
  Velodyne lidar(velodyne_params(), LaserId::kFront);
  std::int64_t now_us = kBeginUs;
  lidar.start(now_us);
  bool found = false;
  for (std::size_t i = 0; i < bytes.size(); i += velodyne::kPacketBytes) {
    now_us += 664;  // of 12 firings
    const auto datagram = bytes.subspan(i, std::min(velodyne::kPacketBytes, bytes.size() - i));
    for (const LaserScan& scan : lidar.receive(datagram, now_us)) {
      found = true;
      if (scan.ranges_m.size() == 90 && std::abs(scan.utime - now_us) < 1'000'000) continue;
      std::cerr << "a scan that no lidar measures\n";
      std::abort();
    }
    for (const LidarRevolution& revolution : lidar.take_revolutions()) {
      if (revolution.ranges_m.size() == revolution.columns.size() * 16) continue;
      std::cerr << "a revolution whose ranges are not those of its columns\n";
      std::abort();
    }
    lidar.tick(now_us);
  }
  return found ? "" : "no scan";
}

Target velodyne_target() { return {"velodyne", {packets_of_a_turn()}, replay_datagrams}; }

}  // namespace

std::vector<Target> driver_targets() {
  return {lms_target(),  scip_target(), velodyne_target(),
          base_target(), tilt_target(), imu_target()};
}

}  // namespace adit::fuzz

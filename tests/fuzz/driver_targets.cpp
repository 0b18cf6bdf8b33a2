// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
// Fuzz targets for what devices send: whole conversations with a laser, from its first answer to
// scans.
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <functional>
#include <iostream>
#include <memory>
#include <span>
#include <string_view>
#include <vector>

#include "drivers/scip/scip.hpp"
#include "drivers/sick_lms2xx/sick_lms2xx.hpp"
#include "drivers/velodyne/velodyne.hpp"

#include "tests/fuzz/targets.hpp"
#include "tests/support/lasers/lms_emulator.hpp"
#include "tests/support/lasers/scip_emulator.hpp"
#include "tests/support/lasers/vlp16_emulator.hpp"

namespace adit::fuzz {
namespace {

constexpr std::int64_t kBeginUs = 100'000'000;
constexpr std::int64_t kTurnUs = 20'000;
constexpr std::size_t kReadBytes = 400;

/// All that a laser sends to this driver in two seconds.
template <class Emulator>
Bytes conversation(LaserDevice& device, Emulator& laser) {
  Bytes sent;
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
    device.tick(now_us);
    if (device.is_streaming() && sent.size() > 3000) break;
  }
  return sent;
}

/// Gives a new driver these bytes in reads of some hundred. Scans must be ordered and have the
/// beams of the laser. Returns the reason for rejection: no scan was found.
std::string_view replay(LaserDevice& device, std::span<const std::uint8_t> bytes,
                        std::size_t beams_max) {
  std::int64_t now_us = kBeginUs;
  bool found = false;
  std::int64_t last_us = 0;
  device.start(now_us);
  for (std::size_t i = 0; i < bytes.size(); i += kReadBytes) {
    now_us += kTurnUs;
    device.take_requests();
    for (const LaserScan& scan :
         device.receive(bytes.subspan(i, std::min(kReadBytes, bytes.size() - i)), now_us)) {
      if (scan.ranges_m.empty() || scan.ranges_m.size() > beams_max ||
          !std::isfinite(scan.angle_min_rad) || !(scan.angle_step_rad > 0.0)) {
        std::cerr << "a scan that no laser measures\n";
        std::abort();
      }
      found = true;
      last_us = scan.utime;
    }
    device.tick(now_us);
  }
  if (std::abs(last_us - kBeginUs) > 1'000'000'000 && found) {
    std::cerr << "a scan that was measured minutes before or behind its arrival\n";
    std::abort();
  }
  for (int i = 0; i < 50; ++i) device.tick(now_us += 1'000'000);  // all timeouts
  return found ? "" : "no scan";
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
            return replay(fuzzed, bytes, 181);
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
            return replay(fuzzed, bytes, 100'001);
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

std::vector<Target> driver_targets() { return {lms_target(), scip_target(), velodyne_target()}; }

}  // namespace adit::fuzz

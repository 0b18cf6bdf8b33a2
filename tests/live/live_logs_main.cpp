// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
// live_logs write LOG: writes a log of scans for the relay, some of them malformed, and of sealed
//   orders.
// live_logs write-all LOG SECONDS: writes a log with a message of every type, ten times per second.
// live_logs fingerprints: prints every message type, its fingerprint in C++, and a sealed message.
// live_logs check PLAYED RECORDED: checks the log that was recorded while PLAYED was played to the
// relay; prints failed requirements.
#include <iostream>
#include <map>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "common/bus/channels.hpp"
#include "common/bus/log/event_source.hpp"
#include "common/bus/log/lcm_log.hpp"
#include "common/messages/codec.hpp"
#include "common/messages/diagnostics.hpp"
#include "common/messages/mapping/odometry.hpp"
#include "common/messages/navigation.hpp"
#include "common/messages/sensing.hpp"
#include "common/seal/seal_sender.hpp"
#include "tests/live/checks/log_check.hpp"
#include "tests/support/message_types.hpp"

namespace adit {
namespace {

constexpr int kScans = 150;
constexpr int kMalformedEvery = 10;
constexpr std::int64_t kStart = 1'600'000'000'000'000;
constexpr std::int64_t kPeriodUs = 13'333;

void write(const std::string& path) {
  LogWriter log(path);
  SealSender seal(SealKey::random());
  for (int i = 0; i < kScans; ++i) {
    const LaserScan scan{kStart + i * kPeriodUs,
                         std::vector<float>(static_cast<std::size_t>(180 + i), 5.0F), -1.5, 0.0087};
    std::vector<std::uint8_t> bytes = encode(to_message(scan));
    if (i % kMalformedEvery == 0) bytes[16] = 0xFF;  // a negative number of beams
    log.write({scan.utime, channels::kLaserFront, bytes});
    const auto order = encode(to_message(DriveCommand{scan.utime, 0.1, 0.0}));
    log.write({scan.utime, channels::kDriveCommand,
               seal.seal(channels::kDriveCommand, order, scan.utime)});
  }
  log.close();
}

void write_all(const std::string& path, int seconds) {
  LogWriter log(path);
  for (int i = 0; i < 10 * seconds; ++i) {
    for (const MessageType& type : message_types()) {
      log.write({kStart + i * std::int64_t{100'000}, type.channel, type.sample});
    }
  }
  log.close();
}

void print_fingerprints() {
  SealSender seal(SealKey::random());
  for (const MessageType& type : message_types()) {
    const auto sealed = seal.seal(type.channel, type.sample, kStart);
    std::cout << fmt::format("{}.{} {} {:02x}\n", type.package, type.name, type.fingerprint,
                             fmt::join(sealed, ""));
  }
}

std::map<std::string, std::vector<std::vector<std::uint8_t>>> by_channel(const std::string& path) {
  LogFile log(path);
  std::map<std::string, std::vector<std::vector<std::uint8_t>>> messages;
  while (const auto event = log.next()) {
    messages[std::string(event->channel)].emplace_back(event->data.begin(), event->data.end());
  }
  return messages;
}

Requirements require;

void check_poses(const std::vector<std::vector<std::uint8_t>>& poses) {
  std::size_t at = 0;
  for (int i = 0; i < kScans; ++i) {
    if (i % kMalformedEvery == 0) continue;
    if (at == poses.size()) break;
    const auto pose = from_message(*decode<pose_t>(poses[at++]));
    require(pose && pose->utime == kStart + i * kPeriodUs && pose->T_odom_body.x == 180.0 + i,
            fmt::format("pose {} matches its scan", i));
  }
  require(poses.size() == kScans - kScans / kMalformedEvery, "each valid scan has a pose");
}

void check(const std::string& played_path, const std::string& recorded_path) {
  auto played = by_channel(played_path);
  auto recorded = by_channel(recorded_path);
  require(recorded["LASER_FRONT"] == played["LASER_FRONT"], "the scans are recorded unchanged");
  check_poses(recorded["POSE"]);
  require(recorded["DRIVE_COMMAND"] == played["DRIVE_COMMAND"],
          "the sealed orders are recorded unchanged");
  const auto order = decode<drive_command_t>(recorded["DRIVE_COMMAND"].at(0));
  require(order && order->speed_m_s == 0.1, "a sealed order in a log is read");

  require(!recorded["CONFIG"].empty(), "the configuration was published");
  const auto config = from_message(*decode<config_t>(recorded["CONFIG"].at(0)));
  require(config && config->stage == "relay" && config->yaml.find("y_m") != std::string::npos,
          "the configuration is that of the relay");

  const auto heartbeat = from_message(*decode<heartbeat_t>(recorded["HEARTBEAT"].back()));
  require(heartbeat && heartbeat->rejected == kScans / kMalformedEvery,
          "malformed scans are rejected and counted");
}

}  // namespace
}  // namespace adit

int main(int argc, char** argv) {
  const std::vector<std::string> arguments(argv + 1, argv + argc);
  if (arguments.size() == 2 && arguments[0] == "write") {
    adit::write(arguments[1]);
  } else if (arguments.size() == 3 && arguments[0] == "write-all") {
    adit::write_all(arguments[1], std::stoi(arguments[2]));
  } else if (arguments.size() == 1 && arguments[0] == "fingerprints") {
    adit::print_fingerprints();
  } else if (arguments.size() == 3 && arguments[0] == "check") {
    adit::check(arguments[1], arguments[2]);
  } else {
    std::cerr
        << "live_logs write LOG | write-all LOG SECONDS | fingerprints | check PLAYED RECORDED\n";
    return 2;
  }
  return adit::require.exit_code();
}

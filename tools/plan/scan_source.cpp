// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "tools/plan/scan_source.hpp"

#include <array>
#include <fstream>
#include <set>
#include <stdexcept>

#include "common/bus/channels.hpp"
#include "common/bus/replay_bus.hpp"
#include "common/bus/typed.hpp"
#include "common/config/config.hpp"
#include "common/messages/cloud_pieces.hpp"
#include "procs/scan_assembly/scan_assembly_node.hpp"
#include "sim/simulation/simulation_params.hpp"
#include "tools/map/recorded_lasers.hpp"

namespace adit {
namespace {

constexpr std::size_t kPiecesWaiting = 1000;
constexpr std::int64_t kHearOutUs = 20'000'000;  // longer than a sweep waits for anything

std::vector<Cloud> recorded_clouds(const LogFile& log, std::vector<std::string>& complaints) {
  std::vector<Cloud> clouds;
  CloudAssembler assembler;
  std::size_t refused = 0;
  for (const LogEventView& event : log.events()) {
    if (event.channel != channels::kCloud) continue;
    const auto message = decode<cloud_t>(event.data);
    const auto piece = message ? from_message(*message) : Result<CloudPiece>(Refused{"damaged"});
    if (!piece) {
      ++refused;
      continue;
    }
    if (auto cloud = assembler.add(*piece)) clouds.push_back(std::move(*cloud));
  }
  if (refused > 0) {
    complaints.push_back("skipped " + std::to_string(refused) + " damaged messages of CLOUD");
  }
  if (const auto lost = assembler.counts().superseded; lost > 0) {
    complaints.push_back("skipped " + std::to_string(lost) + " scans that lack pieces");
  }
  return clouds;
}

Lasers find_lasers(const ConfigFile& config, const LogFile& log,
                   std::vector<std::string>& complaints) {
  if (config.section(Lasers::kSection) != nullptr) {
    return load_section<Lasers>(config, Lasers::kSection);
  }
  if (const auto recorded = recorded_lasers(log.events())) return *recorded;
  complaints.emplace_back("neither config nor log say where the lasers are: taken for Groundhog's");
  return groundhog_lasers();
}

/// Channels without which no scan can be put together and that the log does not have.
std::string missing_channels(const LogFile& log) {
  std::set<std::string_view> there;
  for (const LogEventView& event : log.events()) there.insert(event.channel);
  std::string missing;
  const auto need = [&](std::string_view one, std::string_view other) {
    if (there.contains(one) || there.contains(other)) return;
    missing += (missing.empty() ? " (it lacks " : ", ") + std::string(one);
  };
  need(channels::kScanRequest, channels::kScanRequest);
  need(channels::kLaserFront, channels::kLaserRear);
  need(channels::kTiltFront, channels::kTiltRear);
  need(channels::kPose, channels::kPose);
  return missing.empty() ? missing : missing + ")";
}

ReplayOptions without_results() {
  ReplayOptions options;
  for (const auto channel :
       {channels::kCloud, channels::kTiltCommandFront, channels::kTiltCommandRear}) {
    options.leave_out.emplace(channel);
  }
  return options;
}

std::vector<Cloud> assembled_clouds(LogFile& log, const ConfigFile& config,
                                    std::vector<std::string>& complaints) {
  auto params = load_section<ScanAssemblyNode::Params>(config, "scan_assembly");
  params.lasers = find_lasers(config, log, complaints);
  ReplayBus bus(log, nullptr, without_results());
  std::vector<Cloud> clouds;
  CloudAssembler assembler;
  subscribe<cloud_t>(bus, channels::kCloud, Delivery::queued(kPiecesWaiting),
                     [&](const CloudPiece& piece) {
                       if (auto cloud = assembler.add(piece)) clouds.push_back(std::move(*cloud));
                     });
  const ScanAssemblyNode node(bus, params);
  bus.run();
  bus.advance_to(bus.now_utime() + kHearOutUs);
  if (const std::string reason = node.health().reason; !reason.empty()) {
    complaints.push_back("scan assembly: " + reason);
  }
  return clouds;
}

std::string last_of(const std::vector<std::string>& complaints) {
  return complaints.empty() ? "" : ": " + complaints.back();
}

}  // namespace

bool is_scan_log(const std::filesystem::path& file) {
  if (file.extension() == ".lcmlog") return true;
  std::ifstream stream(file, std::ios::binary);
  constexpr std::array<unsigned char, 4> kSync{0xED, 0xA1, 0xDA, 0x01};
  for (const unsigned char byte : kSync) {
    if (stream.get() != byte) return false;
  }
  return true;
}

ScanSource scans_of_log(const std::filesystem::path& file, const ConfigFile& config) {
  LogFile log(file);
  ScanSource source;
  if (log.health().corrupt_bytes > 0) {
    source.complaints.push_back("skipped " + std::to_string(log.health().corrupt_bytes) +
                                " corrupt bytes");
  }
  source.clouds = recorded_clouds(log, source.complaints);
  if (!source.clouds.empty()) return source;
  const std::string missing = missing_channels(log);
  if (missing.empty()) source.clouds = assembled_clouds(log, config, source.complaints);
  if (source.clouds.empty()) {
    throw std::runtime_error(file.string() + ": no 3D scan in it, nor what makes one" + missing +
                             last_of(source.complaints));
  }
  return source;
}

std::vector<NumberedScan> choose(const ScanSource& source, const ScanChoice& choice) {
  std::vector<NumberedScan> chosen;
  int number = 0;
  for (const Cloud& cloud : source.clouds) {
    ++number;
    const bool asked = choice.all || choice.number == number || choice.id == cloud.id;
    const bool any = !choice.number && !choice.id && chosen.empty() && cloud.complete;
    if (asked || any) chosen.push_back({number, cloud});
  }
  if (!chosen.empty()) return chosen;
  if (!choice.number && !choice.id) return {{1, source.clouds.front()}};
  throw std::runtime_error("there is no such scan among the " +
                           std::to_string(source.clouds.size()) + ": see --list");
}

}  // namespace adit

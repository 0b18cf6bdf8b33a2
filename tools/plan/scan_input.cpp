// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "tools/plan/scan_input.hpp"

#include <set>
#include <stdexcept>

#include <fmt/format.h>

#include "common/bus/channels.hpp"
#include "common/bus/log/replay_bus.hpp"
#include "common/bus/typed_messages.hpp"
#include "common/config/config.hpp"
#include "common/messages/mapping/cloud.hpp"
#include "procs/scan_assembly/scan_assembly_node.hpp"
#include "sim/simulation/simulation_params.hpp"
#include "tools/map/log_input.hpp"

namespace adit {
namespace {

constexpr std::size_t kFragmentsQueued = 1000;
constexpr std::int64_t kDrainUs = 20'000'000;  // longer than any timeout of scan assembly

std::vector<Cloud> recorded_clouds(const LogFile& log, std::vector<std::string>& warnings) {
  std::vector<Cloud> clouds;
  CloudReassembler assembler;
  std::size_t rejected = 0;
  for (const LogEventView& event : log.events()) {
    if (event.channel != channels::kCloud) continue;
    const auto message = decode<cloud_t>(event.data);
    const auto fragment =
        message ? from_message(*message) : Result<CloudFragment>(Rejected{"malformed"});
    if (!fragment) {
      ++rejected;
      continue;
    }
    if (auto cloud = assembler.add(*fragment)) clouds.push_back(std::move(*cloud));
  }
  if (rejected > 0) {
    warnings.push_back(fmt::format("skipped {} malformed messages on CLOUD", rejected));
  }
  if (const auto incomplete = assembler.counts().superseded; incomplete > 0) {
    warnings.push_back(fmt::format("skipped {} scans with missing fragments", incomplete));
  }
  return clouds;
}

Lasers find_lasers(const ConfigFile& config, const LogFile& log,
                   std::vector<std::string>& warnings) {
  if (config.section(Lasers::kSection) != nullptr) {
    return load_section<Lasers>(config, Lasers::kSection);
  }
  if (const auto recorded = recorded_lasers(log.events(), warnings)) return *recorded;
  warnings.emplace_back(
      "laser poses are neither in the configuration nor in the log; using those of Groundhog");
  return groundhog_lasers();
}

/// The channels that scan assembly requires and the log does not have, in parentheses.
std::string missing_channels(const LogFile& log) {
  std::set<std::string_view> present_channels;
  for (const LogEventView& event : log.events()) present_channels.insert(event.channel);
  std::string missing;
  const auto require_any = [&](std::string_view channel, std::string_view alternative) {
    if (present_channels.contains(channel) || present_channels.contains(alternative)) return;
    missing += fmt::format("{}{}", missing.empty() ? " (missing: " : ", ", channel);
  };
  require_any(channels::kScanRequest, channels::kScanRequest);
  require_any(channels::kLaserFront, channels::kLaserRear);
  if (!present_channels.contains(channels::kLidar)) {
    require_any(channels::kTiltFront, channels::kTiltRear);
  }
  require_any(channels::kPose, channels::kPose);
  return missing.empty() ? missing : missing + ")";
}

ReplayOptions without_results() {
  ReplayOptions options;
  for (const auto channel :
       {channels::kCloud, channels::kTiltCommandFront, channels::kTiltCommandRear}) {
    options.excluded_channels.emplace(channel);
  }
  return options;
}

std::vector<Cloud> assembled_clouds(LogFile& log, const ConfigFile& config,
                                    std::vector<std::string>& warnings) {
  auto params = load_section<ScanAssemblyNode::Params>(config, "scan_assembly");
  params.lasers = find_lasers(config, log, warnings);
  ReplayBus bus(log, nullptr, without_results());
  std::vector<Cloud> clouds;
  CloudReassembler assembler;
  subscribe<cloud_t>(bus, channels::kCloud, Delivery::queued(kFragmentsQueued),
                     [&](const CloudFragment& fragment) {
                       if (auto cloud = assembler.add(fragment))
                         clouds.push_back(std::move(*cloud));
                     });
  const ScanAssemblyNode node(bus, params);
  bus.run();
  bus.advance_to(bus.now_utime() + kDrainUs);
  if (const std::string reason = node.health().reason; !reason.empty()) {
    warnings.push_back(fmt::format("scan assembly: {}", reason));
  }
  return clouds;
}

std::string last_of(const std::vector<std::string>& warnings) {
  return warnings.empty() ? "" : fmt::format(": {}", warnings.back());
}

}  // namespace

ScanInput scans_of_log(const std::filesystem::path& file, const ConfigFile& config) {
  LogFile log(file);
  ScanInput source;
  if (log.health().corrupt_bytes > 0) {
    source.warnings.push_back(fmt::format("skipped {} corrupt bytes", log.health().corrupt_bytes));
  }
  source.clouds = recorded_clouds(log, source.warnings);
  if (!source.clouds.empty()) return source;
  const std::string missing = missing_channels(log);
  if (missing.empty()) source.clouds = assembled_clouds(log, config, source.warnings);
  if (source.clouds.empty()) {
    throw std::runtime_error(fmt::format("{}: no 3D scan, and no data to assemble one{}{}",
                                         file.string(), missing, last_of(source.warnings)));
  }
  return source;
}

std::vector<NumberedScan> select_scans(const ScanInput& source, const ScanChoice& choice) {
  std::vector<NumberedScan> chosen;
  int number = 0;
  for (const Cloud& cloud : source.clouds) {
    ++number;
    const bool selected = choice.all || choice.number == number || choice.id == cloud.id;
    const bool any = !choice.number && !choice.id && chosen.empty() && cloud.complete;
    if (selected || any) chosen.push_back({number, cloud});
  }
  if (!chosen.empty()) return chosen;
  if (!choice.number && !choice.id) return {{1, source.clouds.front()}};
  throw std::runtime_error(
      fmt::format("no such scan among the {} scans of the log: see --list", source.clouds.size()));
}

}  // namespace adit

// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "tools/volume/volume_run.hpp"

#include <stdexcept>

#include <fmt/format.h>

#include "common/bus/channels.hpp"
#include "common/bus/log/event_source.hpp"
#include "common/bus/log/replay_bus.hpp"
#include "common/bus/node/stages.hpp"
#include "common/config/config.hpp"
#include "procs/volume_map/volume_export.hpp"
#include "procs/volume_map/volume_map_node.hpp"
#include "tools/map/result_folder.hpp"

namespace adit {
namespace {

VolumeMapNodeParams load_params(const std::filesystem::path& path) {
  if (path.empty()) return {};
  const ConfigFile file = ConfigFile::load(path);
  file.require_known_sections(config_sections());
  return load_section<VolumeMapNodeParams>(file, "volume_map");
}

std::vector<std::string> collect_warnings(const LogFile& log, const ReplayBus& bus,
                                          const VolumeMap& map) {
  std::vector<std::string> warnings;
  const auto add_skipped = [&](std::size_t count, const char* kind) {
    if (count > 0) warnings.push_back(fmt::format("skipped {} {}", count, kind));
  };
  add_skipped(log.health().corrupt_bytes, "corrupt bytes");
  add_skipped(log.health().truncated_bytes, "bytes of a truncated event");
  add_skipped(bus.rejected_events(), "events with implausible times");
  add_skipped(static_cast<std::size_t>(map.rejected_points()), "implausible points");
  if (!map.volumes().front().anchor) {
    warnings.emplace_back("no pose graph with a map correction: the scans are placed by odometry");
  }
  return warnings;
}

}  // namespace

VolumeRunResult run_volume(const VolumeRunOptions& options,
                           const std::function<void(double)>& progress) {
  VolumeMapNodeParams params = load_params(options.config);
  params.journal.clear();  // all data is in the log
  LogFile log(options.input);
  ReplayOptions replay;
  replay.excluded_channels.emplace(channels::kVolume);
  ReplayBus bus(log, nullptr, replay);
  const VolumeMapNode node(bus, params);
  bus.run(progress);

  const VolumeMap& map = node.map();
  if (map.volumes().empty()) {
    throw std::runtime_error(
        fmt::format("no 3D scan (channel CLOUD) in {}", options.input.string()));
  }
  const ResultFolder results(options.folder);
  export_volume(map, results.unfinished());
  results.publish();

  VolumeRunResult result;
  result.volumes = map.volumes().size();
  for (const PlacedVolume& placed : map.volumes()) {
    result.scans += placed.volume.scans();
    result.points += placed.volume.points().size();
  }
  result.warnings = collect_warnings(log, bus, map);
  return result;
}

}  // namespace adit

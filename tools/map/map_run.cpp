// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "tools/map/map_run.hpp"

#include <algorithm>
#include <chrono>
#include <stdexcept>
#include <utility>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "common/bus/channels.hpp"
#include "common/bus/log/replay_bus.hpp"
#include "common/bus/node/node_host.hpp"
#include "common/bus/node/stages.hpp"
#include "common/config/config.hpp"
#include "common/files/file_utils.hpp"
#include "common/files/mapped_file.hpp"
#include "common/files/output_file.hpp"
#include "procs/mapping/map_journal.hpp"
#include "procs/mapping/mapping_node.hpp"
#include "procs/scan_matching/scan_matching_node.hpp"
#include "tools/map/doubt_list.hpp"
#include "tools/map/full_map.hpp"
#include "tools/map/log_input.hpp"
#include "tools/map/map_files.hpp"
#include "tools/map/result_folder.hpp"
#include "tools/map/run_record.hpp"
#include "tools/map/stopwatch_bus.hpp"
#include "tools/map/summary.hpp"
#include "tools/ros/import/clouds_on_poses.hpp"

namespace adit {
namespace {

using Clock = std::chrono::steady_clock;

constexpr const char* kGridSection =
    "map_grid";                                  // of this tool, in addition to those of the stages
constexpr double kMatchedShareMin = 0.1;         // of the scans in the log, for a map
constexpr const char* kJournal = "map.journal";  // of mapping: file of the results, name in CONFIG

ConfigFile load_config(const std::filesystem::path& path) {
  if (path.empty()) return {};
  ConfigFile file = ConfigFile::load(path);
  std::vector<std::string> known = config_sections();
  known.emplace_back(kGridSection);
  file.require_known_sections(known);
  return file;
}

/// Laser mounts from the configuration file, otherwise from CONFIG in the log, otherwise defaults.
Lasers find_lasers(const ConfigFile& config, const LogInput& input,
                   std::vector<std::string>& warnings) {
  if (config.section(Lasers::kSection) == nullptr) {
    if (const auto recorded = input.recorded_lasers(warnings)) return *recorded;
  }
  return load_section<Lasers>(config, Lasers::kSection);
}

ConfiguredNode configure_scan_matching(const ConfigFile& config, const Lasers& lasers) {
  constexpr const char* kStage = "scan_matching";
  auto params = load_section<ScanMatchingNode::Params>(config, kStage);
  params.lasers = lasers;
  return configured_node<ScanMatchingNode>(kStage, to_yaml(params, kStage), params);
}

/// The journal is always written into `folder`; CONFIG has its name without the folder. With
/// `resume` the start of the log may be anywhere on the map.
ConfiguredNode configure_mapping(const ConfigFile& config, const Lasers& lasers,
                                 const std::filesystem::path& folder, bool resume) {
  constexpr const char* kStage = "mapping";
  auto params = load_section<MappingNode::Params>(config, kStage);
  params.lasers = lasers;
  params.carried = params.carried || resume;
  params.journal = kJournal;
  const std::string yaml = to_yaml(params, kStage);
  params.journal = (folder / kJournal).string();
  params.scratch = folder;
  return configured_node<MappingNode>(kStage, yaml, params);
}

/// What the disk cannot read is zeros in the copy, which a journal finds to be damaged.
void copy_readable(const std::filesystem::path& from, const std::filesystem::path& to) {
  const MappedFile file(from);
  OutputFile copy(to, to);
  const auto bytes = file.bytes();
  (void)file.is_readable(bytes);  // a system call fails on a page that an access makes zeros
  copy.write({reinterpret_cast<const char*>(bytes.data()), bytes.size()});
  copy.close();
}

/// Copies the journal of an earlier run, both copies of it, into the folder and returns its
/// content.
StoredMap load_resumed_map(const std::filesystem::path& resume,
                           const std::filesystem::path& folder) {
  if (resume.empty()) return {};
  const std::filesystem::path journal = resume / kJournal;
  const std::string copy = journal_copy(kJournal).string();
  const bool has_copy = std::filesystem::is_regular_file(resume / copy);
  if (!std::filesystem::is_regular_file(journal) && !has_copy) {
    throw std::runtime_error(fmt::format("no map to resume: {} does not exist", journal.string()));
  }
  if (std::filesystem::is_regular_file(journal)) copy_readable(journal, folder / kJournal);
  if (has_copy) copy_readable(resume / copy, folder / copy);
  StoredMap stored = read_map_journal(journal);
  // A local map that is lost keeps its number.
  const auto is_lost = [](const LocalMap& map) { return map.utime == 0; };
  if (std::ranges::all_of(stored.maps, is_lost)) {
    const std::string report = map_journal_report(kJournal, stored);
    throw std::runtime_error(fmt::format("no map to resume: no local map in {}{}", journal.string(),
                                         report.empty() ? "" : "; " + report));
  }
  return stored;
}

EarlierMap earlier_map(StoredMap stored, const std::filesystem::path& scratch) {
  EarlierMap earlier{LocalMapStore(scratch), std::move(stored.associations)};
  for (LocalMap& map : stored.maps) earlier.maps.push_back(std::move(map));
  return earlier;
}

ReplayOptions replay_options(bool use_odometry) {
  ReplayOptions options;
  for (const auto channel : {channels::kPose, channels::kScanMatch, channels::kMatchDoubt,
                             channels::kLocalMap, channels::kPoseGraph, channels::kMapCorrection,
                             channels::kAssociation, channels::kContradictions,
                             channels::kHeartbeat, channels::kConfig, channels::kStageStats}) {
    options.excluded_channels.emplace(channel);
  }
  if (!use_odometry) {
    options.excluded_channels.emplace(channels::kWheelOdometry);
    options.excluded_channels.emplace(channels::kImu);
  }
  return options;
}

MapFilesOptions map_files_options(const ConfigFile& config, const Lasers& lasers,
                                  const MapRunOptions& options) {
  return {options.input.filename().string(),
          load_section<OccupancyGridParams>(config, kGridSection), lasers, options.draw_graph};
}

/// Throws std::runtime_error if next to none of the scans in the log could be matched: what comes
/// out would look like a map of a place where the robot has not been.
void require_matches(const RunRecord& record, const LogInput& input, const MapRunOptions& options) {
  const RunRecord::Counts& counts = record.counts();
  const std::size_t scans = std::max(input.scans(), counts.with_pose + counts.rejected);
  if (counts.with_pose == 0 && counts.rejected == 0 && input.warnings().empty()) {
    throw std::runtime_error(fmt::format("no usable laser scan in {}", options.input.string()));
  }
  if (counts.with_pose > 0 &&
      static_cast<double>(counts.matched) >= kMatchedShareMin * static_cast<double>(scans - 1)) {
    return;
  }
  std::vector<std::string> reasons;
  const auto add = [&](std::size_t count, const char* what) {
    if (count > 0) reasons.push_back(fmt::format("{} {}", count, what));
  };
  add(counts.rejected, "have a time that does not advance");
  add(counts.lost, "do not match those before");
  add(scans - counts.with_pose - counts.rejected, "are malformed or have no usable time");
  for (const std::string& warning : input.warnings()) reasons.push_back(warning);
  if (const std::string times = input.times().text(); !times.empty()) reasons.push_back(times);
  throw std::runtime_error(
      fmt::format("{} in {}: {} of {} scans matched; {}",
                  counts.with_pose == 0 ? "no usable laser scan" : "too few usable laser scans",
                  options.input.string(), counts.matched, scans, fmt::join(reasons, "; ")));
}

/// Throws std::runtime_error if next to none of the scans were matched or, when the run resumes a
/// map, it has no local map of its own session: mapping first completes the last local map of the
/// earlier run.
void require_result(const RunRecord& record, const LogInput& input, const EarlierMap& earlier,
                    const MapRunOptions& options) {
  require_matches(record, input, options);
  const auto& maps = record.local_maps().headers();
  const bool has_own_map = std::any_of(maps.begin(), maps.end(), [&earlier](const LocalMap& map) {
    return earlier.maps.empty() || map.session > earlier.maps.back().session;
  });
  if (!options.resume.empty() && !has_own_map) {
    throw std::runtime_error(
        fmt::format("log too short to continue a map: {}", options.input.string()));
  }
}

/// What scan matching did not use, by channel and reason.
void warn_of_rejected(const HostedNode& scan_matching, std::vector<std::string>& warnings) {
  for (const SubscriptionStats& stats : scan_matching.subscription_stats()) {
    for (const auto& [reason, count] : stats.rejections) {
      warnings.push_back(fmt::format("{}: {} of {} messages rejected: {}", stats.channel, count,
                                     stats.handled + stats.rejected, reason));
    }
  }
}

std::vector<std::string> collect_warnings(const LogInput& input, const ReplayBus& bus) {
  std::vector<std::string> warnings;
  for (const std::string& warning : input.warnings()) {
    warnings.push_back(fmt::format("skipped {}", warning));
  }
  warnings.insert(warnings.end(), input.assumptions().begin(), input.assumptions().end());
  if (const std::string times = input.times().text(); !times.empty()) warnings.push_back(times);
  if (bus.rejected_events() > 0) {
    warnings.push_back(
        fmt::format("skipped {} events with implausible times", bus.rejected_events()));
  }
  return warnings;
}

MapRunResult result_of(const RunRecord& record, const FullMap& map) {
  MapRunResult result;
  result.scans = record.counts().with_pose;
  result.lost = record.counts().lost;
  result.path_length_m = distance_travelled_m(record.odometry(), kTravelStepM);
  result.local_maps = map.local_maps.size();
  result.loop_closures = count_loop_closures(map).accepted;
  result.cross_session_loop_closures = count_cross_session_loop_closures(map);
  return result;
}

}  // namespace

MapRunResult run_map(const MapRunOptions& options,
                     const std::function<void(const std::string&, double)>& progress) {
  const auto start = Clock::now();
  const ConfigFile config = load_config(options.config);
  const ResultFolder results(options.folder);
  const std::filesystem::path& folder = results.unfinished();
  StoredMap stored = load_resumed_map(options.resume, folder);
  const ResumedMap resumed{map_journal_report(kJournal, stored), stored.losses};
  const EarlierMap earlier = earlier_map(std::move(stored), folder);

  LogInput input(options.input, options.topics, folder / "input.lcmlog",
                 [&](double done) { progress("reading", done); });
  std::vector<std::string> config_warnings;
  const Lasers lasers = find_lasers(config, input, config_warnings);
  const MapFilesOptions files = map_files_options(config, lasers, options);
  const auto scan_matching = configure_scan_matching(config, lasers);
  const auto mapping = configure_mapping(config, lasers, folder, !options.resume.empty());
  LogWriter log(folder / "run.lcmlog");
  CloudsOnPoses placed(input.events());
  EventSource& events = input.is_imported() ? placed : input.events();
  ReplayBus bus(events, &log, replay_options(options.use_odometry));
  placed.subscribe_to(bus);
  StopwatchBus scan_stopwatch(
      bus, {std::string(channels::kLaserFront), std::string(channels::kLaserRear)});
  StopwatchBus mapping_stopwatch(bus, {std::string(channels::kScanMatch)});
  RunRecord record(bus, folder);
  const HostedNode scan_matching_hosted(scan_stopwatch, scan_matching);
  const HostedNode mapping_hosted(mapping_stopwatch, mapping);
  bus.run([&](double done) { progress("mapping", done); });
  log.close();

  require_result(record, input, earlier, options);
  const FullMap map = full_map(earlier, record, folder);
  MapRunResult result = result_of(record, map);
  result.warnings = collect_warnings(input, bus);
  if (placed.without_pose() > 0) {
    result.warnings.push_back(
        fmt::format("left out {} messages of 3D scans without a pose", placed.without_pose()));
  }
  warn_of_rejected(scan_matching_hosted, result.warnings);
  result.warnings.insert(result.warnings.end(), config_warnings.begin(), config_warnings.end());
  if (!resumed.report.empty()) result.warnings.push_back(resumed.report);
  if (!options.resume.empty() && result.cross_session_loop_closures == 0) {
    result.warnings.emplace_back(
        "no loop closure to the resumed map: the pose of this run in it is not verified");
  }
  const std::vector<DoubtfulStretch> stretches =
      doubtful_stretches(record.doubts(), record.contradictions(), DistanceAlong(record.odometry()),
                         record.local_maps().headers());
  result.doubtful = stretches_text(stretches);
  if (!write_map_files(map, record, stretches, files, folder)) {
    result.warnings.emplace_back("no map: the poses exceed the size limit of map_grid");
  }
  write_graph_files(map, folder);
  RunCost cost = process_cost();
  cost.scans = scan_stopwatch.handled();
  cost.local_maps = mapping_stopwatch.answered();
  cost.wall_s = std::chrono::duration<double>(Clock::now() - start).count();
  result.wall_s = cost.wall_s;
  write_text_file(summary_json(record, earlier, map, stretches, input.times(), resumed, cost),
                  folder / "summary.json");
  results.publish();
  return result;
}

}  // namespace adit

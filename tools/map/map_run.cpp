// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "tools/map/map_run.hpp"

#include <chrono>
#include <fstream>
#include <stdexcept>

#include "common/bus/channels.hpp"
#include "common/bus/hosted_node.hpp"
#include "common/bus/replay_bus.hpp"
#include "common/bus/stages.hpp"
#include "common/config/config.hpp"
#include "procs/scan_matching/scan_matching_node.hpp"
#include "tools/map/log_input.hpp"
#include "tools/map/map_files.hpp"
#include "tools/map/result_folder.hpp"
#include "tools/map/run_record.hpp"
#include "tools/map/stopwatch_bus.hpp"
#include "tools/map/summary.hpp"

namespace adit {
namespace {

using Clock = std::chrono::steady_clock;

/// The section of the config file that this tool reads itself, beside those of the stages.
constexpr const char* kGridSection = "map_grid";

ConfigFile load_config(const std::filesystem::path& path) {
  if (path.empty()) return {};
  ConfigFile file = ConfigFile::load(path);
  std::vector<std::string> known = stage_names();
  known.emplace_back(kGridSection);
  file.require_known_sections(known);
  return file;
}

ReplayOptions replay_options(bool use_odometry) {
  ReplayOptions options;
  for (const auto channel : {channels::kPose, channels::kScanMatch, channels::kHeartbeat,
                             channels::kConfig, channels::kStageStats}) {
    options.leave_out.emplace(channel);
  }
  if (!use_odometry) {
    options.leave_out.emplace(channels::kWheelOdometry);
    options.leave_out.emplace(channels::kImu);
  }
  return options;
}

void write_text(const std::string& text, const std::filesystem::path& path) {
  std::ofstream out(path);
  out << text;
  if (!out.flush()) throw std::runtime_error("cannot write " + path.string());
}

}  // namespace

MapRunResult run_map(const MapRunOptions& options,
                     const std::function<void(const std::string&, double)>& progress) {
  const auto start = Clock::now();
  const ConfigFile config = load_config(options.config);
  const auto node = configure_node<ScanMatchingNode>("scan_matching", config);
  const auto lasers = load_section<ScanMatchingParams>(config, "scan_matching");
  const auto grid = load_section<OccupancyGridParams>(config, kGridSection);

  const ResultFolder results(options.folder);
  const std::filesystem::path& folder = results.unfinished();
  LogInput input(options.input, folder / "input.lcmlog",
                 [&](double done) { progress("reading", done); });
  LogWriter log(folder / "run.lcmlog");
  ReplayBus bus(input.events(), &log, replay_options(options.use_odometry));
  StopwatchBus stopwatch(bus);
  RunRecord record(bus);
  const HostedNode scan_matching(stopwatch, node);
  bus.run([&](double done) { progress("matching scans", done); });
  log.close();

  MapRunResult result;
  result.complaints = input.complaints();
  if (bus.refused_events() > 0) {
    result.complaints.push_back(std::to_string(bus.refused_events()) +
                                " events with times that cannot be");
  }
  if (record.entries().empty()) {
    throw std::runtime_error("no usable laser scan in " + options.input.string());
  }
  const std::string title = options.input.filename().string();
  if (!write_map_files(record, lasers, grid, title, folder)) {
    result.complaints.emplace_back("no map: the poses are farther apart than map_grid allows");
  }
  RunCost cost = cost_so_far();
  cost.scan_ms = stopwatch.scan_ms();
  cost.wall_s = std::chrono::duration<double>(Clock::now() - start).count();
  write_text(summary_json(record, cost), folder / "summary.json");
  results.publish();

  const Trajectory trajectory = record.trajectory();
  result.scans = record.entries().size();
  for (const auto& entry : record.entries()) {
    result.lost += entry.match.status == ScanMatch::Status::kLost ? 1 : 0;
  }
  result.path_length_m = path_length_m(trajectory);
  result.wall_s = cost.wall_s;
  return result;
}

}  // namespace adit

// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include <cstdint>
#include <filesystem>
#include <iostream>
#include <memory>
#include <optional>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include <CLI/App.hpp>
#include <fmt/format.h>

#include "common/bus/log/event_source.hpp"
#include "common/bus/log/lcm_log.hpp"
#include "common/command_line/command_line.hpp"
#include "common/text/message_text.hpp"
#include "tools/adit/adit_app.hpp"
#include "tools/adit/run_progress.hpp"
#include "tools/export/mcap_export.hpp"
#include "tools/export/ros2/ros2_export.hpp"
#include "viewer/view/viewer_options.hpp"

namespace adit {
namespace {

namespace fs = std::filesystem;

struct ExportOptions {
  std::vector<fs::path> logs;
  fs::path mcap;
  fs::path lcmlog;
  fs::path rosbag2;
  fs::path config;
};

constexpr const char* kExportDetails =
    R"(--mcap writes the topics of the viewer, with their schemas (Foxglove's as Protocol Buffers, others as JSON),
for Foxglove, Lichtblick and the command mcap: poses, lasers, map, 3D scans, pose graph, frontiers, mission.
Messages have the time at which the log was recorded. Map and volume are written as rarely as keeps each
below 100 kB per second of the mission, and at the end.

--rosbag2 writes a folder for the tools of ROS 2 (ros2 bag, RViz): an MCAP file with messages of sensor_msgs, nav_msgs,
geometry_msgs and tf2_msgs in CDR, which other readers of MCAP open alone, and metadata.yaml. Topics: /scan_front, /scan_rear,
/wheel_odometry, /imu, /pose, /path, /cloud, /map, /tf, /tf_static; frames: map, odom, base_link, laser_front, laser_rear.
Scans are complete; the map is written every ten seconds and at the end.

--lcmlog writes the messages as they are, as one LCM log: compressed with zstd if the name ends with .zst,
plain otherwise, for lcm-logplayer. All commands read both.

Several logs are those of one mission; they are read by the time of their first message. A file has its name
when it is complete.)";

constexpr const char* kExportExamples =
    R"(  adit export mission/run.lcmlog --mcap mission.mcap
  adit export mission/run.lcmlog --rosbag2 mission_bag
  adit export run.lcmlog --lcmlog run.lcmlog.zst       compress a log
  adit export run.lcmlog.zst --lcmlog run.lcmlog       and decompress it)";

void export_to_rosbag2(const ExportOptions& options) {
  const ViewerParameters parameters = load_viewer_parameters(options.config);
  std::optional<RunProgress> progress(std::in_place, options.rosbag2);
  const Ros2Export result =
      export_ros2(options.logs, options.rosbag2, parameters.scene,
                  [&progress](double done) { progress->update("exporting", done); });
  progress.reset();
  for (const std::string& warning : result.warnings) print_error("adit", warning);
  std::cout << fmt::format("{}: {} messages of {} topics\n", options.rosbag2.string(),
                           result.messages, result.topics);
}

void export_to_mcap(const ExportOptions& options) {
  const ViewerParameters parameters = load_viewer_parameters(options.config);
  McapExport result;
  {
    RunProgress progress(options.mcap);
    result = export_mcap(options.logs, options.mcap, parameters.scene,
                         [&](double done) { progress.update("exporting", done); });
  }
  for (const std::string& warning : result.warnings) print_error("adit", warning);
  std::cout << fmt::format("{}: {} messages of {} topics\n", options.mcap.string(), result.messages,
                           result.topics);
}

/// Throws std::runtime_error if the file is one of the logs.
void require_other_file(const fs::path& file, const std::vector<fs::path>& logs) {
  for (const fs::path& log : logs) {
    if (fs::exists(file) && fs::equivalent(file, log))
      throw std::runtime_error(fmt::format("{}: is the log to export", file.string()));
  }
}

void export_to_lcmlog(const ExportOptions& options) {
  LogWriter writer(options.lcmlog, LogWriter::Name::kWhenClosed);
  LogHealth lost;
  {
    RunProgress progress(options.lcmlog);
    const std::vector<fs::path> logs = in_order_of_time(options.logs);
    for (std::size_t i = 0; i < logs.size(); ++i) {
      LogReader reader(logs[i]);
      while (const auto event = reader.next()) {
        writer.write(*event);
        progress.update("exporting", (static_cast<double>(i) + reader.fraction_read()) /
                                         static_cast<double>(logs.size()));
      }
      lost += reader.health();
    }
  }
  if (writer.events() == 0) {
    throw std::runtime_error(fmt::format("no message in {}", options.logs.front().string()));
  }
  writer.close();
  if (lost.corrupt_bytes + lost.truncated_bytes > 0) {
    print_error("adit", fmt::format("skipped {} corrupt bytes, and {} bytes of truncated events",
                                    lost.corrupt_bytes, lost.truncated_bytes));
  }
  std::cout << fmt::format("{}: {} messages, {:.1f} MB\n", options.lcmlog.string(), writer.events(),
                           1e-6 * static_cast<double>(fs::file_size(options.lcmlog)));
}

void run(const ExportOptions& options) {
  if (options.mcap.empty() && options.lcmlog.empty() && options.rosbag2.empty())
    throw std::invalid_argument("one of --mcap, --rosbag2 and --lcmlog is required");
  if (!options.rosbag2.empty()) return export_to_rosbag2(options);
  const fs::path& file = options.mcap.empty() ? options.lcmlog : options.mcap;
  require_other_file(file, options.logs);
  if (options.mcap.empty()) return export_to_lcmlog(options);
  export_to_mcap(options);
}

}  // namespace

void add_export_command(CLI::App& adit) {
  CLI::App* command = add_command(
      adit, "export",
      "Convert LCM logs to MCAP for Foxglove, a rosbag2, or a compressed or plain LCM log");
  set_help(*command, {kExportDetails, "", kExportExamples});
  const auto options = std::make_shared<ExportOptions>();
  command->add_option("LOG", options->logs, "LCM logs of one mission")
      ->type_name("FILE")
      ->required();
  CLI::Option* const mcap =
      command->add_option("--mcap", options->mcap, "MCAP file to write")->type_name("FILE");
  CLI::Option* const lcmlog = command
                                  ->add_option("--lcmlog", options->lcmlog,
                                               "LCM log to write; compressed if it ends with .zst")
                                  ->type_name("FILE")
                                  ->excludes(mcap);
  command->add_option("--rosbag2", options->rosbag2, "Folder to write, for the tools of ROS 2")
      ->type_name("DIR")
      ->excludes(mcap)
      ->excludes(lcmlog);
  command
      ->add_option("--config", options->config,
                   "YAML file with a section viewer, for --mcap and --rosbag2")
      ->type_name("FILE");
  command->callback([options] { run(*options); });
}

}  // namespace adit

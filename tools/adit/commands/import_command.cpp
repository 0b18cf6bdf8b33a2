// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
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
#include <fmt/ranges.h>

#include "common/command_line/command_line.hpp"
#include "common/text/message_text.hpp"
#include "tools/adit/adit_app.hpp"
#include "tools/adit/progress_bar.hpp"
#include "tools/adit/topic_options.hpp"
#include "tools/carmen/carmen_import.hpp"
#include "tools/ros/import/bag_import.hpp"
#include "tools/ros/import/cloud_sequence_import.hpp"

namespace adit {
namespace {

struct ImportOptions {
  std::filesystem::path input;
  std::filesystem::path output;
};

constexpr const char* kCarmenDetails =
    R"(Scans are written to channel LASER_FRONT and wheel odometry to WHEEL_ODOMETRY, with their
timestamps. The laser pose of a line is not imported, because many public logs contain corrected poses.
Malformed lines are skipped and reported on standard error, by reason.)";

constexpr const char* kCarmenExamples =
    R"(  adit import carmen intel.log.gz intel.lcmlog
  adit spy intel.lcmlog                           inspect the messages)";

void print_result(const CarmenReport& report, const ImportOptions& options) {
  for (const std::string& message : report.messages()) {
    print_error("adit", fmt::format("{}: skipped {}", options.input.string(), message));
  }
  if (const std::string times = report.times.text(); !times.empty()) {
    print_error("adit", fmt::format("{}: {}", options.input.string(), times));
  }
  std::cout << fmt::format("{}: {} scans, {} odometry lines; {} of {} lines skipped\n",
                           options.output.string(), report.scans, report.odometry_lines,
                           report.rejected_lines(), report.lines);
}

void import_carmen_log(const ImportOptions& options) {
  CarmenReport report;
  {
    ProgressBar bar("importing");
    report = import_carmen(options.input, options.output, [&](double done) { bar.update(done); });
  }
  print_result(report, options);
}

constexpr const char* kBagDetails =
    R"(Bags are those of ROS 1 (without compression, bz2, lz4), of rosbag2 (the folder, or one of its files: sqlite3 or
MCAP, without compression, lz4 or zstd) and MCAP files with messages of ROS 1 or ROS 2.

  LaserScan, MultiEchoLaserScan   LASER_FRONT, LASER_REAR; of several echoes the first
  PointCloud2                     as --front: its level slice, within 0.1 m or 1.5 degrees of the height of the
                                  sensor, on LASER_FRONT; as --clouds: 3D scans, on CLOUD
  Odometry, or tf                 WHEEL_ODOMETRY
  Imu                             IMU, rotated into the body
  tf, tf_static                   CONFIG: where the lasers are mounted, which adit map reads

Topics are chosen if the bag leaves no doubt: one laser, or two of which tf says that one looks ahead and one back;
one Odometry, otherwise the frame with odom in the name of its parent in tf; one Imu. Otherwise the error lists the
topics. The body is the child frame of Odometry, else base_link, else base_footprint, else what the laser is mounted on.

Scans of a laser that turns are used only where it is as level as it gets. 3D scans have the pose of the odometry,
with its drift (adit map gives them those of scan matching), and no beams without return. The motion during the turn of a 3D lidar is not corrected. What
is damaged is skipped and reported on standard error.)";

constexpr const char* kBagExamples =
    R"(  adit import bag run.bag --list                    the topics
  adit import bag run.bag run.lcmlog
  adit import bag rosbag2_2024_05_01 run.lcmlog --front /scan_filtered --odometry none
  adit import bag velodyne.mcap run.lcmlog --clouds /velodyne_points
  adit map run.bag --out mine                       maps a bag directly)";

constexpr const char* kCloudsDetails =
    R"(DIR has a file PCD, PLY or XYZ for each 3D scan, in the frame of a level body (x forward, z up), in order of their names.
Each becomes a CLOUD, and its level slice (as in adit import bag) a scan on LASER_FRONT. A name that is a number is the time,
in seconds, or in ns from 10^17 on; otherwise the times are those of --poses, one for each file, or 0.1 s apart.

Without --poses the 3D scans have no place: each is at the origin.)";

constexpr const char* kCloudsExamples =
    R"(  adit import clouds scans/ scans.lcmlog
  adit import clouds scans/ scans.lcmlog --poses odometry.tum
  adit plan scans.lcmlog --out plan                 plans in each 3D scan
  adit map scans/ --out map                         maps the level slices directly)";

struct BagOptions {
  std::filesystem::path input;
  std::filesystem::path output;
  BagImportOptions import;
  bool list = false;
};

struct CloudsOptions {
  std::filesystem::path folder;
  std::filesystem::path output;
  std::filesystem::path poses;
};

void print_skipped(const std::filesystem::path& input, const std::vector<std::string>& skipped,
                   const std::vector<std::string>& warnings) {
  for (const std::string& text : skipped)
    print_error("adit", fmt::format("{}: skipped {}", input.string(), text));
  for (const std::string& text : warnings)
    print_error("adit", fmt::format("{}: {}", input.string(), text));
}

void list_topics(const BagOptions& options) {
  std::optional<ProgressBar> bar(std::in_place, "reading");
  const BagSurvey survey =
      survey_bag(options.input, false, [&bar](double done) { bar->update(done); });
  bar.reset();
  print_skipped(options.input, survey.warnings, {});
  for (const SurveyedTopic& topic : survey.topics) {
    std::cout << message_line(fmt::format("{:>8}  {:<32}  {}{}", topic.messages, topic.topic.type,
                                          topic.topic.name,
                                          topic.frame.empty() ? "" : "  frame " + topic.frame))
              << "\n";
  }
}

/// The topics that were converted, by what they became.
std::string used_topics(const TopicChoice& topics) {
  std::vector<std::string> texts;
  const auto add = [&texts](const char* what, const std::string& name) {
    if (!name.empty() && name != TopicChoice::kNone)
      texts.push_back(fmt::format("{} {}", what, name));
  };
  add("front", topics.front);
  add("rear", topics.rear);
  add("odometry", topics.odometry);
  add("IMU", topics.imu);
  add("3D scans", topics.clouds);
  add("body", topics.base_frame);
  return message_line(fmt::format("{}", fmt::join(texts, ", ")));
}

void import_ros_bag(const BagOptions& options) {
  if (options.list) return list_topics(options);
  if (options.output.empty()) throw std::invalid_argument("OUT or --list is required");
  std::optional<ProgressBar> bar(std::in_place, "importing");
  const BagImport result = import_bag(options.input, options.output, options.import,
                                      [&bar](double done) { bar->update(done); });
  bar.reset();
  print_skipped(options.input, result.skipped, result.warnings);
  std::cout << fmt::format("{}: {} scans, {} odometry, {} IMU, {} 3D scans ({})\n",
                           options.output.string(), result.scans, result.odometry, result.imu,
                           result.clouds, used_topics(result.topics));
}

void import_clouds(const CloudsOptions& options) {
  std::optional<ProgressBar> bar(std::in_place, "importing");
  const CloudSequenceImport result = import_cloud_sequence(
      options.folder, options.output, options.poses, [&bar](double done) { bar->update(done); });
  bar.reset();
  print_skipped(options.folder, result.skipped, result.warnings);
  std::cout << fmt::format("{}: {} 3D scans with {} points\n", options.output.string(),
                           result.clouds, result.points);
}

void add_bag_import(CLI::App& import) {
  CLI::App* bag =
      add_command(import, "bag", "Convert a bag of ROS (ROS 1, rosbag2, MCAP) to an LCM log");
  set_help(*bag, {kBagDetails, "", kBagExamples});
  const auto options = std::make_shared<BagOptions>();
  bag->add_option("IN", options->input, "Bag: a file, or the folder of a rosbag2")
      ->type_name("FILE")
      ->required();
  bag->add_option("OUT", options->output, "LCM log to write")->type_name("FILE");
  bag->add_flag("--list", options->list, "Print the topics only");
  add_topic_options(*bag, options->import.topics);
  bag->add_option("--cloud-spacing-m", options->import.cloud_spacing_m,
                  "Distance travelled from one 3D scan to the next")
      ->type_name("M")
      ->capture_default_str()
      ->check(number_in(at_least(0.0)));
  bag->callback([options] { import_ros_bag(*options); });
}

void add_clouds_import(CLI::App& import) {
  CLI::App* clouds =
      add_command(import, "clouds",
                  "Convert a folder of point clouds (PCD, PLY, XYZ) to an LCM log of 3D scans");
  set_help(*clouds, {kCloudsDetails, "", kCloudsExamples});
  const auto options = std::make_shared<CloudsOptions>();
  clouds->add_option("DIR", options->folder, "Folder of point clouds")
      ->type_name("DIR")
      ->required();
  clouds->add_option("OUT", options->output, "LCM log to write")->type_name("FILE")->required();
  clouds->add_option("--poses", options->poses, "Poses of the body: time x y z qx qy qz qw (TUM)")
      ->type_name("FILE");
  clouds->callback([options] { import_clouds(*options); });
}

}  // namespace

void add_import_command(CLI::App& adit) {
  CLI::App* import = add_command(adit, "import", "Convert a log of another format to an LCM log");
  import->require_subcommand(1);
  add_bag_import(*import);
  add_clouds_import(*import);
  CLI::App* carmen = add_command(
      *import, "carmen", "Convert a CARMEN log (FLASER, ROBOTLASER1 and ODOM lines) to an LCM log");
  set_help(*carmen, {kCarmenDetails, "", kCarmenExamples});
  const auto options = std::make_shared<ImportOptions>();
  carmen->add_option("IN", options->input, "CARMEN log, plain or gzip")
      ->type_name("FILE")
      ->required();
  carmen->add_option("OUT", options->output, "LCM log to write")->type_name("FILE")->required();
  carmen->callback([options] { import_carmen_log(*options); });
}

}  // namespace adit

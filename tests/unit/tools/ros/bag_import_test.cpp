// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
// Whole imports of bags against what was put into them.
#include "tools/ros/import/bag_import.hpp"

#include <cmath>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <map>
#include <numbers>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "common/bus/log/event_source.hpp"
#include "common/bus/memory_bus.hpp"
#include "common/bus/node/recorded_section.hpp"
#include "common/messages/codec.hpp"
#include "common/messages/mapping/cloud.hpp"
#include "common/messages/mapping/odometry.hpp"
#include "common/messages/sensing.hpp"
#include "tests/support/scratch_folder.hpp"
#include "tools/export/mcap_writer.hpp"
#include "tools/export/ros2/cdr_writer.hpp"
#include "tools/export/ros2/ros2_messages.hpp"
#include "tools/ros/import/cloud_sequence_import.hpp"
#include "tools/ros/import/clouds_on_poses.hpp"
#include "tools/ros/import/level_scan.hpp"
#include "tools/ros/messages/ros_messages.hpp"

namespace adit {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

constexpr double kPi = std::numbers::pi;
constexpr std::int64_t kBegin = 1'700'000'000'000'000;

Eigen::Isometry3d pose(const Eigen::Vector3d& p, double roll, double pitch, double yaw) {
  Eigen::Isometry3d T = Eigen::Isometry3d::Identity();
  T.translation() = p;
  T.linear() = (Eigen::AngleAxisd(yaw, Eigen::Vector3d::UnitZ()) *
                Eigen::AngleAxisd(pitch, Eigen::Vector3d::UnitY()) *
                Eigen::AngleAxisd(roll, Eigen::Vector3d::UnitX()))
                   .toRotationMatrix();
  return T;
}

/// A bag of rosbag2 as the drivers of a robot record it.
class BagImportTest : public testing::Test {
 protected:
  void write(const std::string& topic, const char* type, std::int64_t utime,
             const std::string& bytes) {
    const auto known = channels_.find(topic);
    const auto id = known != channels_.end() ? known->second
                                             : channels_[topic] = writer_.add_channel(
                                                   topic, "cdr", {type, "ros2msg", ""});
    writer_.write(id, utime, utime, bytes);
  }

  void write_tf(const std::string& topic, const ros2::StampedTransform& transform) {
    write(topic, ros2::kTfMessage, transform.utime == 0 ? kBegin : transform.utime,
          ros2::transforms({transform}));
  }

  void write_scan(const std::string& topic, const std::string& frame, int i) {
    LaserScan scan{kBegin + i * 100'000, std::vector<float>(181, 3.0F), -0.5 * kPi, kPi / 180.0};
    scan.ranges_m[0] = 0.01F * static_cast<float>(i);
    LaserMount mount;
    mount.range_min_m = 0.2;
    mount.range_max_m = 25.0;
    write(topic, ros2::kLaserScan, scan.utime, ros2::laser_scan(scan, mount, frame));
  }

  void write_odometry(const std::string& topic, int i) {
    CdrWriter message;
    message.header(kBegin + i * 100'000, "odom").text("base_link");
    for (const double value : {0.5 * i, 0.0, 0.0, 0.0, 0.0, 0.0, 1.0}) message.f64(value);
    for (int k = 0; k < 36 + 6 + 36; ++k) message.f64(0.0);
    write(topic, ros2::kOdometry, kBegin + i * 100'000, message.bytes());
  }

  void write_cloud(const std::string& topic, int i) {
    CdrWriter message;
    message.header(kBegin + i * 100'000, "velodyne").u32(1).u32(1).u32(3);
    std::size_t offset = 0;
    for (const char* name : {"x", "y", "z"}) {
      message.text(name).u32(offset).u8(7).u32(1);
      offset += 4;
    }
    CdrWriter point;  // its encapsulation of 4 bytes does not belong to the data
    point.f32(2.0F).f32(0.0F).f32(0.5F);
    message.u8(0).u32(12).u32(12).bytes(point.bytes().substr(4)).u8(1);
    write(topic, ros2::kPointCloud2, kBegin + i * 100'000, message.bytes());
  }

  BagImport import(const BagImportOptions& options = {}) {
    writer_.close();
    BagImport result = import_bag(folder_ / "a.mcap", folder_ / "a.lcmlog", options, [](double) {});
    LogFile log(folder_ / "a.lcmlog");
    for (const LogEventView& event : log.events()) {
      events_[std::string(event.channel)].push_back(
          {event.utime, std::string(event.channel), {event.data.begin(), event.data.end()}});
    }
    return result;
  }

  template <class Message>
  auto value(const std::string& channel, std::size_t i) {
    return *from_message(*decode<Message>(events_.at(channel).at(i).data));
  }

  Lasers lasers() {
    std::vector<std::string> warnings;
    return recorded_section<Lasers>(value<config_t>("CONFIG", 0), "lasers", warnings).value();
  }

  test::ScratchFolder folder_;
  McapWriter writer_{folder_ / "a.mcap", "ros2"};
  std::map<std::string, std::uint16_t> channels_;
  std::map<std::string, std::vector<LogEvent>> events_;
};

TEST_F(BagImportTest, ConvertsEachReadingAndTheMountOfTheLaser) {
  write_tf("/tf_static", {0, "base_link", "laser", pose({0.8, 0.1, 0.6}, kPi, 0.0, 0.2)});
  write_tf("/tf_static", {0, "base_link", "imu", pose({0.0, 0.0, 0.0}, 0.0, 0.0, 0.5 * kPi)});
  for (int i = 0; i < 10; ++i) {
    write_scan("/scan", "laser", i);
    write_odometry("/odom", i);
    CdrWriter imu;
    imu.header(kBegin + i * 100'000, "imu");
    for (int k = 0; k < 13; ++k) imu.f64(0.0);
    imu.f64(0.1).f64(0.0).f64(0.3);
    for (int k = 0; k < 9; ++k) imu.f64(0.0);
    imu.f64(1.0).f64(0.0).f64(9.8);
    for (int k = 0; k < 9; ++k) imu.f64(0.0);
    write("/imu/data", ros2::kImu, kBegin + i * 100'000, imu.bytes());
  }
  const BagImport result = import();
  EXPECT_EQ(result.scans, 10U);
  EXPECT_EQ(result.odometry, 10U);
  EXPECT_EQ(result.imu, 10U);
  EXPECT_THAT(result.warnings, IsEmpty());
  EXPECT_THAT(result.skipped, IsEmpty());
  EXPECT_EQ(result.topics.base_frame, "base_link");

  const LaserMount mount = lasers().front;
  EXPECT_NEAR(mount.T_body_laser.x, 0.8, 1e-9);
  EXPECT_NEAR(mount.T_body_laser.theta, 0.2, 1e-9);
  EXPECT_NEAR(mount.height_m, 0.6, 1e-9);
  EXPECT_NEAR(mount.range_max_m, 25.0, 1e-6);
  const auto scan = value<planar_lidar_t>("LASER_FRONT", 7);
  EXPECT_EQ(scan.utime, kBegin + 700'000);
  EXPECT_FLOAT_EQ(scan.ranges_m.back(), 0.07F);  // upside down: the first beam is the last
  EXPECT_DOUBLE_EQ((value<wheel_odometry_t>("WHEEL_ODOMETRY", 4).T_wheel_body.x), 2.0);
  const auto imu = value<imu_t>("IMU", 0);
  EXPECT_LT((imu.angular_velocity - Eigen::Vector3d(0.0, 0.1, 0.3)).norm(), 1e-9);
  EXPECT_LT((imu.linear_acceleration - Eigen::Vector3d(0.0, 1.0, 9.8)).norm(), 1e-9);
}

TEST(LevelScan, KnowsTheTurnsOfALaserByTheTimeBetweenItsBeams) {
  RosLaserScan scan;
  scan.angle_step_rad = kPi / 180.0;
  EXPECT_FALSE(timing_of(scan));  // 0: the driver does not say
  scan.time_increment_s = 0.1 / 360.0;
  const auto timing = timing_of(scan);
  ASSERT_TRUE(timing);
  EXPECT_NEAR(timing->mirror_hz, 10.0, 1e-9);
  EXPECT_EQ(timing->mirror_turns, 1);
  EXPECT_FALSE(timing->clockwise);
  scan.angle_step_rad = -scan.angle_step_rad;
  EXPECT_TRUE(timing_of(scan)->clockwise);
  scan.time_increment_s = 5.0;
  EXPECT_FALSE(timing_of(scan));
}

/// What is written for ROS states the timing, by which it is read again.
TEST(LevelScan, IsReadAsItWasWritten) {
  LaserMount mount;
  mount.timing = {.mirror_hz = 40.0, .mirror_turns = 1, .clockwise = false};
  const LaserScan scan{kBegin, {1.0F, 2.0F, 3.0F, 4.0F, 5.0F}, -0.5, 0.25};
  for (const bool clockwise : {false, true}) {
    mount.timing.clockwise = clockwise;
    const std::string bytes = ros2::laser_scan(scan, mount, "laser");
    const auto read = ros_laser_scan(
        {{reinterpret_cast<const std::uint8_t*>(bytes.data()), bytes.size()}, "cdr"});
    ASSERT_TRUE(read);
    EXPECT_GT(read->time_increment_s, 0.0);
    const auto timing = timing_of(*read);
    ASSERT_TRUE(timing);
    EXPECT_NEAR(timing->mirror_hz, 40.0, 1e-3);
    EXPECT_EQ(timing->clockwise, clockwise);
    EXPECT_EQ(level_scan(*read, false)->ranges_m, scan.ranges_m);
    EXPECT_EQ(read->utime, kBegin);  // of the beam that was measured first
  }
  // A SICK measures every other beam a turn later.
  mount.timing = {.mirror_hz = 75.0, .mirror_turns = 2, .clockwise = false};
  const std::string bytes = ros2::laser_scan(scan, mount, "laser");
  EXPECT_FALSE(timing_of(*ros_laser_scan(
      {{reinterpret_cast<const std::uint8_t*>(bytes.data()), bytes.size()}, "cdr"})));
}

TEST_F(BagImportTest, TellsTheFrontFromTheRearLaserByTf) {
  write_tf("/tf_static", {0, "base_link", "a", pose({-0.5, 0.0, 0.3}, 0.0, 0.0, kPi)});
  write_tf("/tf_static", {0, "base_link", "b", pose({0.5, 0.0, 0.3}, 0.0, 0.0, 0.0)});
  for (int i = 0; i < 3; ++i) {
    write_scan("/scan_a", "a", i);
    write_scan("/scan_b", "b", i);
  }
  const BagImport result = import();
  EXPECT_EQ(result.topics.front, "/scan_b");
  EXPECT_EQ(result.topics.rear, "/scan_a");
  EXPECT_NEAR(lasers().rear.T_body_laser.x, -0.5, 1e-9);
  EXPECT_EQ(events_.at("LASER_REAR").size(), 3U);
}

TEST_F(BagImportTest, ListsTheTopicsWhereSeveralCouldBeMeant) {
  for (int i = 0; i < 3; ++i) {
    write_scan("/scan", "laser", i);
    write_scan("/scan_filtered", "laser", i);
  }
  try {
    import();
    FAIL();
  } catch (const std::runtime_error& error) {
    EXPECT_THAT(error.what(), HasSubstr("--front TOPIC"));
    EXPECT_THAT(error.what(), HasSubstr("/scan (sensor_msgs/LaserScan, 3 messages)"));
    EXPECT_THAT(error.what(), HasSubstr("/scan_filtered"));
  }
  EXPECT_FALSE(std::filesystem::exists(folder_ / "a.lcmlog"));
  BagImportOptions options;
  options.topics.front = "/scan_filtered";
  EXPECT_EQ(import_bag(folder_ / "a.mcap", folder_ / "a.lcmlog", options, [](double) {}).scans, 3U);
  options.topics.front = "/odom";
  EXPECT_THROW(import_bag(folder_ / "a.mcap", folder_ / "b.lcmlog", options, [](double) {}),
               std::runtime_error);
}

TEST_F(BagImportTest, TakesTheOdometryOfTf) {
  write_tf("/tf_static", {0, "base_link", "laser", pose({0.3, 0.0, 0.0}, 0.0, 0.0, 0.0)});
  for (int i = 0; i < 5; ++i) {
    write_tf("/tf", {kBegin + i * 100'000, "odom", "base_link",
                     pose({0.1 * i, 0.0, 0.0}, 0.0, 0.0, 0.01 * i)});
    write_scan("/scan", "laser", i);
  }
  const BagImport result = import();
  EXPECT_EQ(result.topics.odometry, "tf");
  EXPECT_EQ(result.odometry, 5U);
  const auto last = value<wheel_odometry_t>("WHEEL_ODOMETRY", 4).T_wheel_body;
  EXPECT_NEAR(last.x, 0.4, 1e-12);
  EXPECT_NEAR(last.theta, 0.04, 1e-12);
}

/// A laser that nods: scans count where it is level.
TEST_F(BagImportTest, SkipsTheScansOfALaserThatHasTurned) {
  for (int i = 0; i < 20; ++i) {
    const double pitch = i < 10 ? 0.0 : 0.05 * (i - 9);
    write_tf("/tf",
             {kBegin + i * 100'000, "base_link", "laser", pose({0.3, 0.0, 0.5}, 0.0, pitch, 0.0)});
    write_scan("/scan", "laser", i);
  }
  const BagImport result = import();
  EXPECT_EQ(result.scans, 10U);
  EXPECT_EQ(result.rejected_scans, 10U);
  EXPECT_THAT(result.skipped, ElementsAre(HasSubstr("10 scans of a laser that had turned")));
}

TEST_F(BagImportTest, SaysThatTfDoesNotHaveTheLaser) {
  for (int i = 0; i < 3; ++i) {
    write_scan("/scan", "laser", i);
    write_odometry("/odom", i);
  }
  EXPECT_THAT(import().warnings,
              ElementsAre(HasSubstr("tf does not connect 'base_link' with 'laser'")));
}

/// A sensor 1 m above the body: the point is at the height of 1.5 m, 2 m ahead of where the body
/// was.
TEST_F(BagImportTest, PlacesThreeDimensionalScansByOdometry) {
  write_tf("/tf_static", {0, "base_link", "velodyne", pose({0.0, 0.0, 1.0}, 0.0, 0.0, 0.0)});
  for (int i = 0; i < 9; ++i) {
    write_odometry("/odom", i);
    write_cloud("/points", i);
  }
  BagImportOptions options;
  options.topics.clouds = "/points";
  const BagImport result = import(options);
  EXPECT_EQ(result.clouds, 3U);  // 4 m with 2 m between them
  EXPECT_EQ(result.scans, 9U);   // and the level slices, which have no point
  const auto second = value<cloud_t>("CLOUD", 1);
  EXPECT_NEAR(second.part.T_odom_level.x, 2.0, 1e-9);
  EXPECT_EQ(second.part.id, 1);
  ASSERT_EQ(second.part.lines.size(), 1U);
  EXPECT_LT((second.part.lines[0].points[0] - Eigen::Vector3f(2.0F, 0.0F, 1.5F)).norm(), 1e-6F);
  EXPECT_LT((second.part.lines[0].origin - Eigen::Vector3f(0.0F, 0.0F, 1.0F)).norm(), 1e-6F);
}

/// Scan matching finds another motion than the odometry of the log; poses lie before and behind the
/// scan.
TEST(CloudsOnPoses, GivesAThreeDimensionalScanThePoseOfScanMatching) {
  const auto cloud_at = [](std::int64_t utime) {
    Cloud cloud;
    cloud.utime = utime;
    cloud.T_odom_level = {100.0, 0.0, 0.0};
    return LogEvent{utime, "CLOUD", encode(to_message(split(cloud).at(0)))};
  };
  const auto other = [](std::int64_t utime) { return LogEvent{utime, "LASER_FRONT", {1}}; };
  EventList source({other(kBegin), cloud_at(kBegin + 50'000), other(kBegin + 100'000),
                    other(kBegin + 200'000), cloud_at(kBegin + 9'000'000)});
  CloudsOnPoses placed(source);
  MemoryBus bus;
  placed.subscribe_to(bus);
  std::vector<LogEvent> events;
  while (const auto event = placed.next()) {
    events.push_back(
        {event->utime, std::string(event->channel), {event->data.begin(), event->data.end()}});
    if (event->channel != "LASER_FRONT") continue;
    StampedPose pose;
    pose.utime = event->utime;
    pose.T_odom_body = {1e-6 * static_cast<double>(event->utime - kBegin), 0.0, 0.0};
    pose.z_m = 0.5;
    bus.inject(event->utime, "POSE", encode(to_message(pose)));
  }
  ASSERT_EQ(events.size(), 4U);
  EXPECT_EQ(events[2].channel, "CLOUD");  // behind the pose that follows it
  const auto cloud = from_message(*decode<cloud_t>(events[2].data));
  ASSERT_TRUE(cloud);
  EXPECT_NEAR(cloud->part.T_odom_level.x, 0.05, 1e-9);
  EXPECT_NEAR(cloud->part.z_odom_m, 0.5, 1e-9);
  EXPECT_EQ(placed.without_pose(), 1U);  // that at the end
}

TEST(CloudSequence, IsPlacedByItsPosesInTheOrderOfItsNumbers) {
  const test::ScratchFolder folder;
  std::filesystem::create_directory(folder / "scans");
  for (const int i : {2, 10, 1}) {
    std::ofstream(folder / fmt::format("scans/scan_{}.xyz", i)) << fmt::format("{} 0 0.05\n", i);
  }
  std::ofstream(folder / "scans/scan_11.xyz") << "no point\n";
  std::ofstream(folder / "poses.tum")
      << "1700000000 5 0 0 0 0 0 1\n1700000010 7 1 0 0 0 0 1\n1700000020 9 2 0 0 0 0 1\n"
         "1700000030 9 2 0 0 0 0 1\n";
  const CloudSequenceImport result = import_cloud_sequence(folder / "scans", folder / "a.lcmlog",
                                                           folder / "poses.tum", [](double) {});
  EXPECT_EQ(result.clouds, 3U);
  EXPECT_THAT(result.skipped, ElementsAre(HasSubstr("scan_11.xyz")));
  EXPECT_THAT(result.warnings, IsEmpty());
  LogFile log(folder / "a.lcmlog");
  std::vector<Cloud> clouds;
  for (const LogEventView& event : log.events()) {
    if (event.channel == "CLOUD")
      clouds.push_back(from_message(*decode<cloud_t>(event.data))->part);
  }
  ASSERT_EQ(clouds.size(), 3U);
  EXPECT_EQ(clouds[2].utime, kBegin + 20'000'000);
  EXPECT_EQ(clouds[2].T_odom_level, (Pose2{4.0, 2.0, 0.0}));
  EXPECT_EQ(clouds[2].lines[0].points[0].x(), 10.0F);
}

}  // namespace
}  // namespace adit

// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "tools/ros/import/cloud_sequence_import.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <optional>
#include <set>
#include <stdexcept>

#include <fmt/format.h>

#include "common/bus/channels.hpp"
#include "common/bus/log/lcm_log.hpp"
#include "common/bus/node/version.hpp"
#include "common/config/config.hpp"
#include "common/messages/codec.hpp"
#include "common/messages/diagnostics.hpp"
#include "common/messages/mapping/cloud.hpp"
#include "common/messages/sensing.hpp"
#include "common/sensing/laser_mount.hpp"
#include "tools/cloud/cloud_file.hpp"
#include "tools/eval/trajectory.hpp"
#include "tools/ros/import/bag_import.hpp"
#include "tools/ros/import/level_scan.hpp"
#include "tools/ros/import/placed_cloud.hpp"

namespace adit {
namespace {

namespace fs = std::filesystem;

constexpr std::int64_t kAssumedBeginUs = 1'000'000'000'000'000;  // of scans without times
constexpr std::int64_t kAssumedPeriodUs = 100'000;
constexpr double kNanosecondsFrom = 1e17;  // no time in seconds, and ns since 1973

bool is_cloud_file(const fs::path& file) {
  static const std::set<std::string> kExtensions{".pcd", ".ply", ".xyz"};
  return kExtensions.contains(file.extension().string());
}

/// In order of their names, scan_2 before scan_10.
std::vector<fs::path> cloud_files(const fs::path& folder) {
  std::vector<fs::path> files;
  for (const auto& entry : fs::directory_iterator(folder)) {
    if (entry.is_regular_file() && is_cloud_file(entry.path())) files.push_back(entry.path());
  }
  std::ranges::sort(files, [](const fs::path& a, const fs::path& b) {
    const std::string left = a.filename().string();
    const std::string right = b.filename().string();
    // Times with and without decimals have the same number of digits before the point.
    const auto digits = [](const std::string& name) { return name.find_first_of('.'); };
    return digits(left) == digits(right) ? left < right : digits(left) < digits(right);
  });
  return files;
}

/// The time that a name states; nothing if it is no time.
std::optional<std::int64_t> time_in_name(const fs::path& file) {
  const std::string name = file.stem().string();
  char* end = nullptr;
  const double value = std::strtod(name.c_str(), &end);
  if (name.empty() || *end != '\0' || !std::isfinite(value) || value < 1e6) return std::nullopt;
  if (value >= kNanosecondsFrom) return std::strtoll(name.c_str(), nullptr, 10) / 1000;
  return std::llround(value * 1e6);
}

/// The times of the files, and where the body was.
class Placement {
 public:
  Placement(const std::vector<fs::path>& files, const fs::path& poses) {
    if (!poses.empty()) trajectory_ = read_tum(poses);
    for (const fs::path& file : files) {
      if (const auto utime = time_in_name(file)) utimes_.push_back(*utime);
    }
    by_name_ = utimes_.size() == files.size();
    if (by_name_) {
      if (!std::ranges::is_sorted(utimes_, std::less_equal<>()))
        throw std::runtime_error("the names of the files are no increasing times");
      return;
    }
    if (!poses.empty() && trajectory_.size() != files.size()) {
      throw std::runtime_error(fmt::format("{} poses in {} for {} files without times",
                                           trajectory_.size(), poses.string(), files.size()));
    }
    utimes_.clear();
    for (std::size_t i = 0; i < files.size(); ++i) {
      utimes_.push_back(poses.empty()
                            ? kAssumedBeginUs + static_cast<std::int64_t>(i) * kAssumedPeriodUs
                            : trajectory_[i].utime);
    }
  }

  [[nodiscard]] bool has_poses() const { return !trajectory_.empty(); }
  [[nodiscard]] bool assumes_times() const { return !by_name_ && !has_poses(); }
  [[nodiscard]] std::int64_t utime(std::size_t file) const { return utimes_[file]; }
  /// T_odom_body, the first pose being the origin; nothing outside of the poses.
  [[nodiscard]] std::optional<Eigen::Isometry3d> pose(std::size_t file) const {
    if (!has_poses()) return Eigen::Isometry3d::Identity();
    const auto pose = interpolate_in_space(trajectory_, utimes_[file]);
    if (!pose) return std::nullopt;
    const TimedPose& first = trajectory_.front();
    return in_space(between(first.pose, pose->pose), pose->z_m - first.z_m);
  }

 private:
  Trajectory trajectory_;
  std::vector<std::int64_t> utimes_;
  bool by_name_ = false;
};

/// The points of a file; nothing, with the reason among the skipped, if it cannot be read.
std::optional<PointCloud> readable(const fs::path& file, std::vector<std::string>& skipped) {
  try {
    PointCloud cloud = read_cloud_file(file);
    if (cloud.skipped > 0)
      skipped.push_back(fmt::format("{} points of {}", cloud.skipped, file.filename().string()));
    return cloud;
  } catch (const std::runtime_error& error) {
    skipped.emplace_back(error.what());
    return std::nullopt;
  }
}

/// Says that the log is imported, and how high the sensor is.
void write_config(LogWriter& log, const PointCloud& first, std::int64_t utime) {
  Lasers lasers;
  if (first.sensor) lasers.front.height_m = first.sensor->z();
  log.write({utime, channels::kConfig,
             encode(to_message(ConfigSnapshot{utime, kImportStage, version(),
                                              to_yaml(lasers, Lasers::kSection)}))});
}

void write_scan(LogWriter& log, const PointCloud& file, std::int64_t utime) {
  const Eigen::Vector3d sensor = file.sensor.value_or(Eigen::Vector3d::Zero());
  std::vector<Eigen::Vector3f> points;
  for (const Eigen::Vector3d& p : file.points)
    points.emplace_back((p - Eigen::Vector3d(0.0, 0.0, sensor.z())).cast<float>());
  LaserScan scan = level_scan(points);
  scan.utime = utime;
  log.write({utime, channels::kLaserFront, encode(to_message(scan))});
}

void write_cloud(LogWriter& log, const PointCloud& file, std::int64_t utime, std::int32_t id,
                 const Eigen::Isometry3d& T_odom_body) {
  std::vector<Eigen::Vector3f> points;
  for (const Eigen::Vector3d& p : file.points) points.emplace_back(p.cast<float>());
  Cloud cloud = placed_cloud(points, utime, Eigen::Isometry3d::Identity(), T_odom_body);
  cloud.id = id;
  if (file.sensor) {
    for (CloudLine& line : cloud.lines) line.origin = file.sensor->cast<float>();
  }
  for (const CloudFragment& fragment : split(cloud))
    log.write({utime, channels::kCloud, encode(to_message(fragment))});
}

}  // namespace

bool is_cloud_folder(const fs::path& folder) {
  std::error_code ignored;
  if (!fs::is_directory(folder, ignored)) return false;
  return std::ranges::any_of(fs::directory_iterator(folder, ignored),
                             [](const auto& entry) { return is_cloud_file(entry.path()); });
}

CloudSequenceImport import_cloud_sequence(const fs::path& folder, const fs::path& lcm_log,
                                          const fs::path& poses,
                                          const std::function<void(double)>& progress) {
  if (!is_cloud_folder(folder)) {
    throw std::runtime_error(
        fmt::format("no folder with files .pcd, .ply or .xyz: {}", folder.string()));
  }
  const std::vector<fs::path> files = cloud_files(folder);
  const Placement placement(files, poses);
  CloudSequenceImport result;
  LogWriter log(lcm_log, LogWriter::Name::kWhenClosed);
  for (std::size_t i = 0; i < files.size(); ++i) {
    progress(static_cast<double>(i) / static_cast<double>(files.size()));
    const auto cloud = readable(files[i], result.skipped);
    if (!cloud) continue;
    const auto T_odom_body = placement.pose(i);
    if (!T_odom_body) {
      result.skipped.push_back(
          fmt::format("{}: no pose at its time", files[i].filename().string()));
      continue;
    }
    if (result.clouds == 0) write_config(log, *cloud, placement.utime(i));
    write_scan(log, *cloud, placement.utime(i));
    write_cloud(log, *cloud, placement.utime(i), static_cast<std::int32_t>(result.clouds++),
                *T_odom_body);
    result.points += cloud->points.size();
  }
  if (result.clouds == 0)
    throw std::runtime_error(fmt::format("no usable file: {}", result.skipped.front()));
  if (placement.assumes_times())
    result.warnings.emplace_back("the files have no times: 0.1 s from one to the next is assumed");
  if (!placement.has_poses())
    result.warnings.emplace_back("no poses: each 3D scan is at the origin of odom");
  log.close();
  return result;
}

}  // namespace adit

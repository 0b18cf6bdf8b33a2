// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "viewer/scene/layers/cloud_layer.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <unordered_set>

#include "common/volume/voxel_grid.hpp"
#include "viewer/scene/foxglove_values.hpp"
#include "viewer/scene/topic_schema.hpp"

namespace adit {
namespace {

namespace values = foxglove_values;

constexpr std::int64_t kVolumePeriodUs = 2'000'000;
constexpr std::int64_t kCloudPeriodUs = 500'000;
constexpr std::uint8_t kUnknownClearance = 255;
constexpr double kClearanceUnitM = 0.05;

template <class T>
void append(std::string& data, T value) {
  std::array<char, sizeof(T)> bytes;
  std::memcpy(bytes.data(), &value, sizeof(T));
  data.append(bytes.data(), bytes.size());
}

void append_point(std::string& data, const Eigen::Vector3d& p) {
  for (const double coordinate : p) append(data, static_cast<float>(coordinate));
}

/// A cloud without points, in frame map.
foxglove::PointCloud empty_cloud(std::int64_t utime, std::uint32_t stride) {
  foxglove::PointCloud message;
  values::set_time(*message.mutable_timestamp(), utime);
  message.set_frame_id("map");
  values::set_pose(*message.mutable_pose(), LevelPose{});
  message.set_point_stride(stride);
  std::uint32_t offset = 0;
  for (const char* name : {"x", "y", "z"}) {
    values::add_field(message, name, offset, foxglove::PackedElementField::FLOAT32);
    offset += sizeof(float);
  }
  return message;
}

}  // namespace

CloudLayer::CloudLayer(TopicBoard& board, const MapFrame& frame, const SceneParameters& parameters)
    : board_(board),
      frame_(frame),
      points_max_(static_cast<std::size_t>(parameters.volume_points_max)),
      voxel_m_(parameters.volume_cell_m) {
  const auto& type = *foxglove::PointCloud::descriptor();
  cloud_topic_ =
      board.add(protobuf_topic("/cloud", type, kCloudPeriodUs), [this] { return cloud_message(); });
  volume_topic_ = board.add(protobuf_topic("/volume", type, kVolumePeriodUs),
                            [this] { return volume_message(); });
}

void CloudLayer::add_cloud(const Cloud& cloud, int number) {
  newest_ = cloud;
  T_newest_ = frame_.anchored({cloud.T_odom_level, cloud.z_odom_m});
  std::vector<Point> points;
  points.reserve(cloud.points());
  for (const CloudLine& line : cloud.lines) {
    for (const Eigen::Vector3f& p_level : line.points) points.push_back({p_level});
  }
  scans_.push_back({cloud.utime, static_cast<std::uint16_t>(number), T_newest_, thinned(points)});
  points_ += scans_.back().points.size();
  enforce_limit();
  board_.set_changed(cloud_topic_, cloud.utime);
  set_changed(cloud.utime);
}

void CloudLayer::add_terrain(const TerrainMap& terrain) {
  const auto scan = std::find_if(scans_.rbegin(), scans_.rend(),
                                 [&](const Scan& other) { return other.utime == terrain.utime; });
  if (scan == scans_.rend()) return;
  for (Point& point : scan->points) {
    const Eigen::Vector2d p_plan = point.p_level.head<2>().cast<double>();
    const Eigen::Vector2i cell = terrain.cell_at(p_plan);
    if (!terrain.cells.contains(cell)) continue;
    const TerrainCell& ground = terrain.cells.at(cell);
    if (ground.ground != Ground::kObserved || !std::isfinite(ground.clearance_m)) continue;
    const double units = std::clamp(static_cast<double>(ground.clearance_m) / kClearanceUnitM, 0.0,
                                    kUnknownClearance - 1.0);
    point.clearance = static_cast<std::uint8_t>(std::lround(units));
  }
  set_changed(terrain.utime);
}

/// The first point of each voxel.
std::vector<CloudLayer::Point> CloudLayer::thinned(const std::vector<Point>& points) const {
  const VoxelGrid grid(voxel_m_);
  std::unordered_set<VoxelCode> taken;
  std::vector<Point> kept;
  for (const Point& point : points) {
    const auto keys = grid.keys_of(point.p_level);
    if (keys && taken.insert(VoxelGrid::code_of(*keys)).second) kept.push_back(point);
  }
  return kept;
}

/// The points of a surface are inversely proportional to the area of a side of the voxels.
void CloudLayer::enforce_limit() {
  while (points_ > points_max_) {
    voxel_m_ *= std::sqrt(2.0);
    points_ = 0;
    for (Scan& scan : scans_) {
      scan.points = thinned(scan.points);
      points_ += scan.points.size();
    }
    if (points_ <= scans_.size()) return;
  }
}

std::string CloudLayer::cloud_message() const {
  const LevelPose T_map_level = frame_.T_map(T_newest_);
  foxglove::PointCloud message = empty_cloud(newest_.utime, 3 * sizeof(float));
  for (const CloudLine& line : newest_.lines) {
    for (const Eigen::Vector3f& p_level : line.points)
      append_point(*message.mutable_data(), T_map_level * Eigen::Vector3d(p_level.cast<double>()));
  }
  return message.SerializeAsString();
}

std::string CloudLayer::volume_message() const {
  constexpr std::uint32_t kCoordinates = 3 * sizeof(float);
  constexpr std::uint32_t kStride = kCoordinates + sizeof(std::uint16_t) + sizeof(std::uint8_t);
  if (scans_.empty()) return {};
  foxglove::PointCloud message = empty_cloud(scans_.back().utime, kStride);
  values::add_field(message, "scan", kCoordinates, foxglove::PackedElementField::UINT16);
  values::add_field(message, "clearance", kStride - 1, foxglove::PackedElementField::UINT8);
  std::string& data = *message.mutable_data();
  data.reserve(kStride * points_);
  for (const Scan& scan : scans_) {
    const LevelPose T_map_level = frame_.T_map(scan.T_level);
    for (const Point& point : scan.points) {
      append_point(data, T_map_level * Eigen::Vector3d(point.p_level.cast<double>()));
      append(data, scan.number);
      append(data, point.clearance);
    }
  }
  return message.SerializeAsString();
}

}  // namespace adit

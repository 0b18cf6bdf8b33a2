// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include <Eigen/Core>

#include "common/types/cloud.hpp"
#include "common/types/terrain_map.hpp"
#include "viewer/scene/map_frame.hpp"
#include "viewer/scene/scene_parameters.hpp"
#include "viewer/server/topic_board.hpp"

namespace adit {

/// The 3D scans: /cloud, the newest one, and /volume, all of them with one point per voxel. When
/// all points exceed volume_points_max the voxels become larger.
class CloudLayer {
 public:
  /// All must outlive this.
  CloudLayer(TopicBoard& board, const MapFrame& frame, const SceneParameters& parameters);
  CloudLayer(const CloudLayer&) = delete;
  CloudLayer& operator=(const CloudLayer&) = delete;

  void add_cloud(const Cloud& cloud, int number);
  /// The roof above the ground of a scan.
  void add_terrain(const TerrainMap& terrain);
  /// Poses have changed.
  void set_changed(std::int64_t utime) { board_.set_changed(volume_topic_, utime); }

 private:
  struct Point {
    Eigen::Vector3f p_level;
    std::uint8_t clearance = 255;  ///< [0.05 m]; 255 unknown
  };
  struct Scan {
    std::int64_t utime = 0;
    std::uint16_t number = 0;
    AnchoredPose T_level;
    std::vector<Point> points;
  };

  [[nodiscard]] std::vector<Point> thinned(const std::vector<Point>& points) const;
  void enforce_limit();
  [[nodiscard]] std::string cloud_message() const;
  [[nodiscard]] std::string volume_message() const;

  TopicBoard& board_;
  const MapFrame& frame_;
  TopicId cloud_topic_ = 0;
  TopicId volume_topic_ = 0;
  std::size_t points_max_ = 0;
  double voxel_m_ = 0.1;
  std::size_t points_ = 0;
  Cloud newest_;
  AnchoredPose T_newest_;
  std::vector<Scan> scans_;
};

}  // namespace adit

// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include <Eigen/Geometry>

#include "common/bus/bus.hpp"
#include "common/messages/diagnostics.hpp"
#include "common/messages/mapping/odometry.hpp"
#include "common/sensing/laser_mount.hpp"
#include "common/sensing/laser_scan.hpp"
#include "viewer/scene/map_frame.hpp"
#include "viewer/server/topic_board.hpp"

namespace adit {

/// The robot now: /tf, /pose, /laser/front and /laser/rear, from POSE, LASER_*, TILT_* and CONFIG.
class RobotLayer {
 public:
  /// All must outlive this. `lasers`: until a CONFIG states them.
  RobotLayer(Bus& bus, TopicBoard& board, const MapFrame& frame, const Lasers& lasers);
  RobotLayer(const RobotLayer&) = delete;
  RobotLayer& operator=(const RobotLayer&) = delete;

  [[nodiscard]] const std::optional<StampedPose>& pose() const { return pose_; }
  [[nodiscard]] const Lasers& lasers() const { return lasers_; }
  /// The newest scan; without beams if there is none.
  [[nodiscard]] const LaserScan& scan(LaserId laser) const {
    return laser == LaserId::kFront ? front_.scan : rear_.scan;
  }

 private:
  struct Laser {
    std::string frame;
    TopicId topic = 0;
    LaserScan scan = {};
    double tilt_rad = 0.0;
  };

  void add_laser(Bus& bus, TopicBoard& board, LaserId id, Laser& laser);
  void on_config(const ConfigSnapshot& config);
  [[nodiscard]] Eigen::Isometry3d T_odom_body() const;
  [[nodiscard]] std::string transforms() const;
  [[nodiscard]] std::string pose_message() const;
  [[nodiscard]] std::string scan_message(const Laser& laser) const;

  TopicBoard& board_;
  const MapFrame& frame_;
  Lasers lasers_;
  bool lasers_known_ = false;  ///< from a CONFIG
  std::optional<StampedPose> pose_;
  TopicId tf_topic_ = 0;
  TopicId pose_topic_ = 0;
  Laser front_{.frame = "laser_front"};
  Laser rear_{.frame = "laser_rear"};
};

}  // namespace adit

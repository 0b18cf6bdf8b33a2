// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include <Eigen/Core>

#include "viewer/scene/anchored_path.hpp"
#include "viewer/scene/layers/robot_layer.hpp"
#include "viewer/scene/map_frame.hpp"
#include "viewer/server/topic_board.hpp"

namespace adit {

/// The 95 % ellipses of the position relative to the start, /uncertainty: of the robot, and as it
/// was along the path, from MAP_CORRECTION.
class UncertaintyLayer {
 public:
  static constexpr double kSpacingM = 20.0;  ///< along the path
  static constexpr std::size_t kPlacesMax = 2000;

  /// All must outlive this.
  UncertaintyLayer(TopicBoard& board, const MapFrame& frame, const AnchoredPath& path,
                   const RobotLayer& robot);
  UncertaintyLayer(const UncertaintyLayer&) = delete;
  UncertaintyLayer& operator=(const UncertaintyLayer&) = delete;

  void add_correction(const MapCorrection& correction);

 private:
  struct Place {
    AnchoredPose T_body;
    double distance_m = 0.0;
    Eigen::Matrix3d covariance = Eigen::Matrix3d::Zero();  ///< as MapCorrection::body_covariance
    double z_variance = 0.0;
  };

  [[nodiscard]] std::string ellipses_message() const;

  TopicBoard& board_;
  const MapFrame& frame_;
  const AnchoredPath& path_;
  const RobotLayer& robot_;
  TopicId topic_ = 0;
  std::vector<Place> places_;
};

}  // namespace adit

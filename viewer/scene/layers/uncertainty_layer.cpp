// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "viewer/scene/layers/uncertainty_layer.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include <fmt/format.h>

#include "common/geometry/symmetric_eigen.hpp"
#include "viewer/scene/foxglove_values.hpp"
#include "viewer/scene/topic_schema.hpp"

namespace adit {
namespace {

namespace values = foxglove_values;

constexpr std::int64_t kUncertaintyPeriodUs = 1'000'000;
const double kFactorPlan = std::sqrt(5.991);  // 95 % of a normal distribution in the plane
constexpr double kFactorHeight = 1.960;       // and on a line
constexpr int kCorners = 36;

/// Adds the ellipse of a position at T_map_body, with the covariance in the frame of the body.
void add_ellipse(const std::string& id, const LevelPose& T_map_body,
                 const Eigen::Matrix3d& covariance, double z_variance,
                 const std::string& distance_m, std::int64_t utime, foxglove::SceneUpdate& update) {
  const Eigen::Matrix2d position = covariance.topLeftCorner<2, 2>();
  const auto eigen = symmetric_eigen(position);
  const Eigen::Vector2d axes_m = kFactorPlan * eigen.values.cwiseMax(0.0).cwiseSqrt();
  if (!axes_m.allFinite()) return;
  foxglove::SceneEntity& entity = values::add_entity(update, utime, id);
  values::add_metadata(entity, "semi_axis_m", fmt::format("{:.6f}", axes_m.maxCoeff()));
  values::add_metadata(entity, "height_95_m",
                       fmt::format("{:.6f}", kFactorHeight * std::sqrt(std::max(0.0, z_variance))));
  values::add_metadata(entity, "distance_m", distance_m);
  foxglove::LinePrimitive& line = values::add_line(entity, foxglove::LinePrimitive::LINE_LOOP, 1.5,
                                                   {.r = 0.8, .g = 0.2, .b = 0.6});
  for (int i = 0; i < kCorners; ++i) {
    const double angle = 2.0 * std::numbers::pi * i / kCorners;
    const Eigen::Vector2d p_body =
        eigen.vectors * Eigen::Vector2d(axes_m.x() * std::cos(angle), axes_m.y() * std::sin(angle));
    values::set_point(*line.add_points(),
                      T_map_body * Eigen::Vector3d(p_body.x(), p_body.y(), 0.0));
  }
}

}  // namespace

UncertaintyLayer::UncertaintyLayer(TopicBoard& board, const MapFrame& frame,
                                   const AnchoredPath& path, const RobotLayer& robot)
    : board_(board), frame_(frame), path_(path), robot_(robot) {
  topic_ = board.add(
      protobuf_topic("/uncertainty", *foxglove::SceneUpdate::descriptor(), kUncertaintyPeriodUs),
      [this] { return ellipses_message(); });
}

void UncertaintyLayer::add_correction(const MapCorrection& correction) {
  board_.set_changed(topic_, correction.utime);
  if (path_.poses().empty() || places_.size() >= kPlacesMax) return;
  const AnchoredPath::Pose& pose = path_.poses().back();
  if (!places_.empty() && pose.distance_m < places_.back().distance_m + kSpacingM) return;
  places_.push_back(
      {pose.anchored, pose.distance_m, correction.body_covariance, correction.z_variance});
}

std::string UncertaintyLayer::ellipses_message() const {
  const auto& correction = frame_.correction();
  if (!correction || !robot_.pose()) return {};
  foxglove::SceneUpdate update = values::replacing_update(correction->utime);
  const LevelPose T_odom_body{robot_.pose()->T_odom_body, robot_.pose()->z_m};
  add_ellipse("robot", frame_.T_map_odom() * T_odom_body, correction->body_covariance,
              correction->z_variance, "", correction->utime, update);
  for (const Place& place : places_) {
    add_ellipse(fmt::format("at {:.0f} m", place.distance_m), frame_.T_map(place.T_body),
                place.covariance, place.z_variance, fmt::format("{:.1f}", place.distance_m),
                correction->utime, update);
  }
  return update.SerializeAsString();
}

}  // namespace adit

// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "viewer/scene/layers/path_layer.hpp"

#include <cstddef>
#include <vector>

#include <Eigen/Core>

#include "viewer/scene/foxglove_values.hpp"
#include "viewer/scene/topic_schema.hpp"

namespace adit {
namespace {

namespace values = foxglove_values;
using foxglove::LinePrimitive;

constexpr std::int64_t kTrajectoryPeriodUs = 1'000'000;
constexpr double kTrajectoryPx = 2.0;

}  // namespace

PathLayer::PathLayer(TopicBoard& board, const MapFrame& frame, const AnchoredPath& driven)
    : board_(board), frame_(frame), driven_(driven) {
  const auto& type = *foxglove::SceneUpdate::descriptor();
  trajectory_topic_ = board.add(protobuf_topic("/trajectory", type, kTrajectoryPeriodUs),
                                [this] { return trajectory_message(); });
  path_topic_ = board.add(protobuf_topic("/path", type), [this] { return path_message(); });
}

void PathLayer::set_planned(const PlannedPath& path) {
  planned_ = path;
  board_.set_changed(path_topic_, path.utime);
}

std::string PathLayer::trajectory_message() const {
  const std::vector<AnchoredPath::Pose>& poses = driven_.poses();
  if (poses.empty()) return {};
  const std::int64_t utime = poses.back().utime;
  foxglove::SceneUpdate update = values::replacing_update(utime);
  LinePrimitive* line = nullptr;
  bool homeward = false;
  for (const AnchoredPath::Pose& pose : poses) {
    const Eigen::Vector3d p_map = frame_.T_map(pose.anchored).translation();
    if (!line || pose.homeward != homeward) {
      homeward = pose.homeward;
      const bool continues = line != nullptr;
      const foxglove::Point3 last =
          continues ? line->points(line->points_size() - 1) : foxglove::Point3();
      line = &values::add_line(values::add_entity(update, utime, homeward ? "return" : "outbound"),
                               LinePrimitive::LINE_STRIP, kTrajectoryPx,
                               homeward ? values::Rgba{.r = 0.85, .g = 0.4, .b = 0.0}
                                        : values::Rgba{.r = 0.1, .g = 0.35, .b = 0.8});
      if (continues) *line->add_points() = last;
    }
    values::set_point(*line->add_points(), p_map);
  }
  return update.SerializeAsString();
}

std::string PathLayer::path_message() const {
  foxglove::SceneUpdate update = values::replacing_update(planned_->utime);
  if (planned_->points.empty()) return update.SerializeAsString();
  const double z_m = frame_.T_map_odom().z_m;
  LinePrimitive& line =
      values::add_line(values::add_entity(update, planned_->utime, "path"),
                       LinePrimitive::LINE_STRIP, 3.0, {.r = 0.6, .g = 0.1, .b = 0.7});
  for (const PathPoint& point : planned_->points) {
    const Pose2 T_map_body = frame_.T_map_odom().plan * point.T_odom_body;
    values::set_point(*line.add_points(), {T_map_body.x, T_map_body.y, z_m});
  }
  return update.SerializeAsString();
}

}  // namespace adit

// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "viewer/scene/foxglove_values.hpp"

#include "common/geometry/pose2.hpp"

namespace adit::foxglove_values {
namespace {

void set_vector(foxglove::Vector3& vector, const Eigen::Vector3d& v) {
  vector.set_x(v.x());
  vector.set_y(v.y());
  vector.set_z(v.z());
}

void set_quaternion(foxglove::Quaternion& quaternion, const Eigen::Isometry3d& T) {
  const Eigen::Quaterniond q(T.linear());
  quaternion.set_x(q.x());
  quaternion.set_y(q.y());
  quaternion.set_z(q.z());
  quaternion.set_w(q.w());
}

}  // namespace

void set_time(google::protobuf::Timestamp& timestamp, std::int64_t utime) {
  constexpr std::int64_t kSecondUs = 1'000'000;
  timestamp.set_seconds(utime / kSecondUs);
  timestamp.set_nanos(static_cast<std::int32_t>(utime % kSecondUs * 1000));
}

void set_point(foxglove::Point3& point, const Eigen::Vector3d& p) {
  point.set_x(p.x());
  point.set_y(p.y());
  point.set_z(p.z());
}

void set_pose(foxglove::Pose& pose, const Eigen::Isometry3d& T) {
  set_vector(*pose.mutable_position(), T.translation());
  set_quaternion(*pose.mutable_orientation(), T);
}

void set_pose(foxglove::Pose& pose, const LevelPose& T) { set_pose(pose, in_space(T.plan, T.z_m)); }

void add_transform(foxglove::FrameTransforms& transforms, std::int64_t utime,
                   const std::string& parent, const std::string& child,
                   const Eigen::Isometry3d& T) {
  foxglove::FrameTransform& transform = *transforms.add_transforms();
  set_time(*transform.mutable_timestamp(), utime);
  transform.set_parent_frame_id(parent);
  transform.set_child_frame_id(child);
  set_vector(*transform.mutable_translation(), T.translation());
  set_quaternion(*transform.mutable_rotation(), T);
}

void set_color(foxglove::Color& color, const Rgba& rgba) {
  color.set_r(rgba.r);
  color.set_g(rgba.g);
  color.set_b(rgba.b);
  color.set_a(rgba.a);
}

foxglove::SceneEntity& add_entity(foxglove::SceneUpdate& update, std::int64_t utime,
                                  const std::string& id) {
  foxglove::SceneEntity& entity = *update.add_entities();
  set_time(*entity.mutable_timestamp(), utime);
  entity.set_frame_id("map");
  entity.set_id(id);
  return entity;
}

void add_metadata(foxglove::SceneEntity& entity, const std::string& key, const std::string& value) {
  foxglove::KeyValuePair& pair = *entity.add_metadata();
  pair.set_key(key);
  pair.set_value(value);
}

foxglove::LinePrimitive& add_line(foxglove::SceneEntity& entity, foxglove::LinePrimitive::Type type,
                                  double thickness_px, const Rgba& rgba) {
  foxglove::LinePrimitive& line = *entity.add_lines();
  line.set_type(type);
  set_pose(*line.mutable_pose(), LevelPose{});
  line.set_thickness(thickness_px);
  line.set_scale_invariant(true);
  set_color(*line.mutable_color(), rgba);
  return line;
}

void add_text(foxglove::SceneEntity& entity, const Eigen::Vector3d& p_map,
              const std::string& content) {
  foxglove::TextPrimitive& text = *entity.add_texts();
  set_pose(*text.mutable_pose(), LevelPose{{p_map.x(), p_map.y(), 0.0}, p_map.z()});
  text.set_billboard(true);
  text.set_font_size(12.0);
  text.set_scale_invariant(true);
  set_color(*text.mutable_color(), {.r = 0.1, .g = 0.1, .b = 0.1});
  text.set_text(content);
}

foxglove::SceneUpdate replacing_update(std::int64_t utime) {
  foxglove::SceneUpdate update;
  foxglove::SceneEntityDeletion& deletion = *update.add_deletions();
  set_time(*deletion.mutable_timestamp(), utime);
  deletion.set_type(foxglove::SceneEntityDeletion::ALL);
  return update;
}

}  // namespace adit::foxglove_values

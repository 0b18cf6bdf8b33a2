// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <string>

#include <Eigen/Core>
#include <Eigen/Geometry>

#include "foxglove.pb.h"

#include "common/geometry/level_pose.hpp"

/// Values of Foxglove's messages.
namespace adit::foxglove_values {

/// `utime`: µs since the epoch.
void set_time(google::protobuf::Timestamp& timestamp, std::int64_t utime);
void set_point(foxglove::Point3& point, const Eigen::Vector3d& p);
void set_pose(foxglove::Pose& pose, const Eigen::Isometry3d& T);
void set_pose(foxglove::Pose& pose, const LevelPose& T);

/// Adds T_parent_child.
void add_transform(foxglove::FrameTransforms& transforms, std::int64_t utime,
                   const std::string& parent, const std::string& child, const Eigen::Isometry3d& T);

/// Adds a field of the elements of a grid or cloud.
template <class Message>
void add_field(Message& message, const std::string& name, std::uint32_t offset,
               foxglove::PackedElementField::NumericType type) {
  auto& field = *message.add_fields();
  field.set_name(name);
  field.set_offset(offset);
  field.set_type(type);
}

struct Rgba {
  double r = 0.0;
  double g = 0.0;
  double b = 0.0;
  double a = 1.0;
};
void set_color(foxglove::Color& color, const Rgba& rgba);

/// Adds an entity without end in frame map.
foxglove::SceneEntity& add_entity(foxglove::SceneUpdate& update, std::int64_t utime,
                                  const std::string& id);
void add_metadata(foxglove::SceneEntity& entity, const std::string& key, const std::string& value);
foxglove::LinePrimitive& add_line(foxglove::SceneEntity& entity, foxglove::LinePrimitive::Type type,
                                  double thickness_px, const Rgba& rgba);
void add_text(foxglove::SceneEntity& entity, const Eigen::Vector3d& p_map, const std::string& text);

/// An update that deletes all entities before it adds its own.
foxglove::SceneUpdate replacing_update(std::int64_t utime);

}  // namespace adit::foxglove_values

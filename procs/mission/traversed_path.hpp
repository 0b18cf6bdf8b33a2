// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include <Eigen/Core>

#include "common/geometry/pose2.hpp"

namespace adit {

/// The way of the body in odom: how long it is, and how it leads back to where odom began. Where
/// the body stood as it did once before, what it drove in between is left out: it need not be
/// driven again.
class TraversedPath {
 public:
  /// Whether that is another place.
  bool add(std::int64_t utime, const Pose2& T_odom_body);
  /// A new odom frame: what was driven counts, but nobody can go back on it before it is known
  /// where the new frame lies. Without knowing where the old one lay in map nobody ever can.
  void reset(const std::optional<Pose2>& T_map_odom);
  /// The present odom frame is known to lie there: the way before it leads on from where it begins.
  void anchor(const Pose2& T_map_odom);
  /// What was driven before a restart [m].
  void set_distance_travelled(double distance_travelled_m) {
    distance_travelled_m_ = distance_travelled_m;
  }

  /// Nothing of it lies in an odom frame before that is not tied.
  [[nodiscard]] bool is_anchored() const { return previous_map_poses_.empty(); }
  [[nodiscard]] double distance_travelled_m() const { return distance_travelled_m_; }
  [[nodiscard]] const std::optional<Pose2>& T_odom_body() const { return T_odom_body_; }
  [[nodiscard]] std::int64_t utime() const { return utime_; }
  /// Poses of the body, from where it is back along the way, this far at most.
  [[nodiscard]] std::vector<Pose2> back(double length_m) const;
  /// How long that is [m]; turns on the spot are no way.
  [[nodiscard]] double back_length_m(double length_m) const;
  /// The same all the way back, but only those within a distance of the body.
  [[nodiscard]] std::vector<Pose2> poses_back_within(double distance_m) const;
  /// How far a route from the body on keeps to the way back, a metre beside it at most [m].
  [[nodiscard]] double shared_length_m(const std::vector<Eigen::Vector2d>& route_odom) const;

 private:
  std::int64_t utime_ = 0;
  std::optional<Pose2> T_odom_body_;
  double distance_travelled_m_ = 0.0;
  std::vector<Pose2> poses_;  ///< T_odom_body, the newest last
  std::vector<Pose2>
      previous_map_poses_;  ///< T_map_body in odom frames before, until they are tied
};

/// A place of the own track, as it is kept on the disk.
struct StoredPathPose {
  std::int64_t odom_epoch_utime = 0;  ///< when its odom frame began [µs since the epoch]
  Pose2 T_odom_body;
  std::optional<Pose2> T_map_odom;  ///< as far as it was known there
  bool anchored = false;            ///< so well that the way before leads on from there

  friend bool operator==(const StoredPathPose&, const StoredPathPose&) = default;
};

/// The same bits on machines of one byte order.
std::vector<std::uint8_t> to_bytes(const StoredPathPose& place);
/// Nothing where these are no such bytes.
std::optional<StoredPathPose> stored_path_pose_from(std::span<const std::uint8_t> bytes);

/// The track that these places were, in the odom frame of the last one.
TraversedPath traversed_path_from(const std::vector<StoredPathPose>& places);

}  // namespace adit

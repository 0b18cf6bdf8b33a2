// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <deque>
#include <optional>
#include <span>
#include <vector>

#include <Eigen/Core>

#include "common/geometry/pose2.hpp"
#include "procs/mission/driven_graph.hpp"

namespace adit {

/// The path that the body drove, in odom: its length, the poses back to where odom began, and all
/// ground that it drove over. When the body returns to an earlier pose, the loop in between is
/// removed from the path back, as it need not be retraced; a pose above or below it, on another
/// level, is another one. Nav2 and other stacks call it breadcrumbs.
class TraversedPath {
 public:
  /// Takes the newest pose of the body. Returns true if it is far enough from the last stored one
  /// to be stored. `z_odom_m`: height of the body in odom; 0 if heights are unknown.
  bool add(std::int64_t utime, const Pose2& T_odom_body, double z_odom_m = 0.0);
  /// Begins a new odom frame. The distance stays. The poses are available again once anchor() gives
  /// the new frame in map; they are lost if `T_map_odom` of the old frame is unknown.
  /// `z_map_odom_m`: height of the old frame in map.
  void reset(const std::optional<Pose2>& T_map_odom, double z_map_odom_m = 0.0);
  /// Sets where the present odom frame lies in map, and prepends the poses of earlier odom frames.
  void anchor(const Pose2& T_map_odom, double z_map_odom_m = 0.0);
  /// Odom moved in map by a loop closure: `T_after_before` is the old pose of odom in the new one.
  /// `z_after_before_m` its height. Poses of the newest local maps keep their place in odom,
  /// earlier ones that in map.
  void correct(const Pose2& T_after_before, double z_after_before_m = 0.0);
  /// The distance travelled before a restart [m].
  void set_distance_travelled(double distance_travelled_m) {
    distance_travelled_m_ = distance_travelled_m;
  }

  /// Whether no poses of earlier odom frames wait for anchor().
  [[nodiscard]] bool is_anchored() const { return previous_trail_.empty(); }
  [[nodiscard]] double distance_travelled_m() const { return distance_travelled_m_; }
  /// The newest pose in the present odom frame.
  [[nodiscard]] const std::optional<Pose2>& T_odom_body() const { return T_odom_body_; }
  /// Of T_odom_body() [µs since the epoch].
  [[nodiscard]] std::int64_t utime() const { return utime_; }
  /// T_odom_body from the present pose backwards, over this path length at most.
  [[nodiscard]] std::vector<Pose2> back(double length_m) const;
  /// The length of that path [m]. Turns on the spot have none.
  [[nodiscard]] double back_length_m(double length_m) const;
  /// Height of the body in odom at that pose [m].
  [[nodiscard]] double z_odom_m() const { return z_odom_m_; }
  /// T_odom_body from the present pose backwards, within a distance of the body in plan, on its
  /// level.
  [[nodiscard]] std::vector<Pose2> poses_back_within(double distance_m) const;
  /// As back(), but with loops, so also where the body came back to its start; the last 8 m at
  /// most.
  [[nodiscard]] std::vector<Pose2> recent(double length_m) const;
  /// Length of the first part of a route that follows the path backwards, 1 m beside it at most
  /// [m].
  [[nodiscard]] double shared_length_m(const std::vector<Eigen::Vector2d>& route_odom) const;
  /// The first part of a route that the robot has driven before, in either direction.
  struct KnownPart {
    double along_m = 0.0;          ///< along the route; the path may be longer
    std::vector<Pose2> path_odom;  ///< T_odom_body, from the present pose on
  };
  /// `may_reverse`: the robot sees behind itself.
  [[nodiscard]] KnownPart known_part(const std::vector<Eigen::Vector2d>& route_odom,
                                     bool may_reverse) const;
  /// The same from the first ground on that the robot drove beside the next `join_m` of the route,
  /// which it first has to get onto. `is_symmetric`: it may drive there with its other end ahead.
  [[nodiscard]] KnownPart joined_part(const std::vector<Eigen::Vector2d>& route_odom, double join_m,
                                      bool may_reverse, bool is_symmetric) const;

 private:
  void prepend_previous();

  std::int64_t utime_ = 0;
  std::optional<Pose2> T_odom_body_;
  double z_odom_m_ = 0.0;
  double distance_travelled_m_ = 0.0;
  DrivenGraph ground_;              ///< in odom
  std::vector<std::size_t> trail_;  ///< its nodes on the path back, the newest last
  std::deque<Pose2> recent_;        ///< T_odom_body with loops, the newest last
  // Of earlier odom frames, in map, until anchor().
  DrivenGraph previous_ground_;
  std::vector<std::size_t> previous_trail_;
};

/// The first poses of a path, which is not empty, over this path length or just beyond.
std::vector<Pose2> first_part_of(const std::vector<Pose2>& path, double length_m);

/// Length of the line through poses [m]. Turns on the spot have none.
double length_of_path_m(const std::vector<Pose2>& path);

/// A pose of the traversed path as it is stored on disk.
struct StoredPathPose {
  std::int64_t odom_epoch_utime = 0;  ///< when its odom frame began [µs since the epoch]
  Pose2 T_odom_body;
  std::optional<Pose2> T_map_odom;  ///< if it was known at that time
  bool anchored = false;            ///< the path continues into the odom frames before
  double z_odom_m = 0.0;            ///< height of the body in odom
  double z_map_odom_m = 0.0;        ///< and of odom in map, as T_map_odom

  friend bool operator==(const StoredPathPose&, const StoredPathPose&) = default;
};

/// The bytes in the byte order of the machine.
std::vector<std::uint8_t> to_bytes(const StoredPathPose& pose);
/// Empty if the number of bytes is wrong.
std::optional<StoredPathPose> stored_path_pose_from(std::span<const std::uint8_t> bytes);

/// The traversed path of stored poses, oldest first, in the odom frame of the last one.
TraversedPath traversed_path_from(const std::vector<StoredPathPose>& poses);

}  // namespace adit

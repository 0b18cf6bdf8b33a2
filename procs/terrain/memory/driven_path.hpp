// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <deque>
#include <optional>
#include <vector>

#include "common/geometry/pose2.hpp"

namespace adit {

/// The traversed path of the body, sampled, in odom. What was driven long ago keeps its place in
/// map where odom moves in map (`correct`).
///
/// Where the robot moves to and fro it stays near the same ground however far it drives. Places are
/// therefore related by the shortest path over driven ground: along the traversed path, and across
/// where it meets itself. It meets itself where two places are near to each other in plan and that
/// shortest path is no longer than a vehicle needs to pass above itself; others may lie on another
/// level.
class DrivenPath {
 public:
  struct Place {
    Pose2 T_odom_body;
    double distance_travelled_m;  ///< driven up to it [m]
    std::int64_t utime;
    double position_variance = 0.0;       ///< of the body in map when it was driven [m²]
    std::optional<double> met_at_m = {};  ///< `distance_travelled_m` of the place that it met
  };

  struct Limits {
    double distance_max_m;     ///< driven since a place, or since map placed it; odom drifts
    double path_length_max_m;  ///< shortest path over driven ground; beyond may be another level
    double speed_max_m_s;
  };

  explicit DrivenPath(const Limits& limits) : limits_(limits) {}

  /// Adds a pose. Returns false if the body cannot have driven that far in the time: a new odom
  /// frame has begun, and the path is reset until `anchor`.
  bool add(std::int64_t utime, const Pose2& T_odom_body);
  /// A new odom frame has begun at this time, with or without a jump. Returns false if `add` has
  /// detected it.
  bool reset(std::int64_t odom_epoch_utime);
  /// Sets the pose of the previous odom frame in the current one, and prepends the path in it.
  void anchor(const Pose2& T_odom_previous);
  /// Mapping has placed odom in map: `T_after_before` is its old pose in the new one. Places that
  /// were driven more than kKeepsPlaceInOdomM ago keep their place in map. `position_variance`: of
  /// the body relative to the start, over all directions at most [m²].
  void correct(const Pose2& T_after_before, double position_variance);
  /// Whether what was observed at this distance travelled keeps its place in map, not in odom.
  [[nodiscard]] bool keeps_place_in_map(double distance_travelled_m) const;
  /// Whether odom has drifted too far since then.
  [[nodiscard]] bool has_expired(double distance_travelled_m) const;

  /// Total distance travelled [m], without the noise at standstill.
  [[nodiscard]] double distance_travelled_m() const { return distance_travelled_m_; }
  /// The places on the same level as the newest, which is the last one; oldest first. Of those that
  /// odom alone would have lost, only those that map relates to the present place well enough.
  [[nodiscard]] std::vector<Place> same_level() const;

 private:
  [[nodiscard]] bool can_follow(std::int64_t utime, const Pose2& T_odom_body) const;
  [[nodiscard]] std::vector<double> lengths_to_newest() const;
  [[nodiscard]] bool is_well_placed(const Place& place) const;
  [[nodiscard]] std::size_t index_of(double distance_travelled_m) const;
  void find_meeting();

  Limits limits_;
  double distance_travelled_m_ = 0.0;
  double corrected_at_m_ = 0.0;  ///< distance travelled at the last correction
  double position_variance_ = 0.0;
  std::deque<Place> places_;    ///< oldest first, ascending in distance
  std::deque<Place> previous_;  ///< places in the previous odom frame
  struct Reading {
    std::int64_t utime;
    Pose2 T_odom_body;
  };
  std::optional<Reading> last_;
};

}  // namespace adit

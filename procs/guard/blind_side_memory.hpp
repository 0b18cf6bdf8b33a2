// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <deque>
#include <optional>
#include <vector>

#include <Eigen/Core>

#include "common/geometry/convex_polygon.hpp"
#include "common/geometry/pose2.hpp"
#include "common/grid/grid2.hpp"
#include "common/pose_graph/map_correction.hpp"
#include "common/sensing/laser_mount.hpp"
#include "common/sensing/obstacle_points.hpp"
#include "common/types/vehicle.hpp"
#include "procs/guard/obstacle_check.hpp"

namespace adit {

/// The ground within 8 m that is known to be free, for motions to a side on which the vehicle is
/// blind: where it has been, and where beams passed at the height of obstacles, within 5 m of the
/// laser. Cells of 0.1 m in odom.
///
/// Odom drifts: ground is forgotten 60 m after the vehicle has driven over it, unless a map
/// correction has placed it since. As on the traversed path of the mission, what was driven more
/// than 10 m ago keeps its place in map. A correction that moves the vehicle by more than 0.3 m may
/// be a wrong loop closure: that ground counts again once a scan agrees with the one that is stored
/// nearest. It is forgotten beyond 1.5 m, or if the scan contradicts it. All is forgotten when the
/// pose jumps. What comes there afterwards is not noticed: a vehicle with one laser needs its
/// surroundings to itself.
class BlindSideMemory {
 public:
  BlindSideMemory(const Vehicle& vehicle, const LaserMount& laser);

  void move_to(const Pose2& T_odom_body);
  /// Adds a scan; ignored before the first pose, and until the vehicle has moved 5 cm or 3° since
  /// the last one.
  void observe(const LaserPoints& points);
  /// Places what was driven long ago. Ignored before the first pose.
  void correct(const MapCorrection& correction);

  /// Distance that the body can move along the arc over known ground, up to `within_m` [m]. 0
  /// before the first pose.
  [[nodiscard]] double known_m(const ArcMotion& motion, double within_m) const;

 private:
  struct Place {
    Pose2 T_odom_body;
    double driven_at_m;         ///< odometer
    std::vector<float> free_m;  ///< from the laser, by bearing in body; empty if no scan is stored
  };

  using Places = std::deque<Place>;  ///< oldest first

  void add_place();
  void doubt_places_before(const Places::iterator& recent);
  void settle_doubts(const std::vector<float>& free_m);
  [[nodiscard]] std::optional<double> agreement(const Place& place,
                                                const std::vector<float>& free_m) const;
  void forget_old_places();
  void mark(const Place& place);
  void mark_all_near();
  void move_cells();
  void mark_line(const Eigen::Vector2d& p_odom_from, const Eigen::Vector2d& p_odom_to);
  [[nodiscard]] std::vector<float> free_by_bearing(const LaserPoints& points) const;
  [[nodiscard]] bool is_near(const Place& place) const;
  [[nodiscard]] bool is_known(const Pose2& T_odom_body) const;
  [[nodiscard]] bool is_under_body(const Eigen::Vector2d& p_odom) const;

  ConvexPolygon outline_;
  std::vector<Eigen::Vector2d> edge_;       ///< points just inside the outline, in the body frame
  std::vector<Eigen::Vector2d> footprint_;  ///< points all over it
  LaserMount laser_;
  std::optional<Pose2> T_odom_body_;
  std::optional<Pose2> T_odom_observed_;  ///< at the last scan that was added
  std::optional<Pose2> T_odom_stored_;    ///< at the last scan that was stored with a place
  std::optional<MapCorrection> correction_;
  double corrected_at_m_ = 0.0;  ///< odometer at the last correction
  double odometer_m_ = 0.0;
  Places places_;
  Places doubted_;             ///< older than those: placed by a correction that may be wrong
  Grid2<std::uint8_t> known_;  ///< cells around the vehicle: 1 if known to be free
};

}  // namespace adit

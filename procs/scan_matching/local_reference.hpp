// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <map>
#include <vector>

#include "common/config/bounds.hpp"
#include "common/geometry/pose2.hpp"
#include "common/registration/free_space.hpp"
#include "common/registration/surface_points.hpp"
#include "common/registration/surfel_map.hpp"
#include "common/sensing/laser_scan.hpp"

namespace adit {

/// A preprocessed scan: its points in the level frame of the body, at heights in odom, and the free
/// space that it observed.
struct ScanObservation {
  LaserId laser = LaserId::kFront;
  std::vector<SurfacePoint> points;
  FreeSpace free_space;
  std::vector<std::int32_t> ground_beams;  ///< that hit the ground or the roof; not in `points`
};

struct LocalReferenceParams {
  SurfelMapParams surfels;
  double keyframe_distance_m = 0.1;     ///< a scan is added to the reference after this motion
  double keyframe_angle_rad = 0.1;      ///< or this turn
  double memory_m = 15.0;               ///< walls not observed over this path length are removed
  double contradiction_margin_m = 0.3;  ///< a point deeper in free space is a contradiction

  template <class V>
  void visit(V& v) {
    v("surfels", surfels);
    v("keyframe_distance_m", keyframe_distance_m, at_least(0.0));
    v("keyframe_angle_rad", keyframe_angle_rad, at_least(0.0));
    v("memory_m", memory_m, above(0.0));
    v("contradiction_margin_m", contradiction_margin_m, at_least(0.0));
  }
};

/// The reference of scan matching: the walls observed over the last metres of the traversed path,
/// in odom, and the last keyframe of each laser. Matching against many scans instead of the last
/// one makes the drift over this length negligible.
class LocalReference {
 public:
  explicit LocalReference(const LocalReferenceParams& params)
      : params_(params), surfels_(params.surfels), apart_(params.surfels) {}

  [[nodiscard]] const SurfelMap& surfels() const { return surfels_; }
  /// Whether the reference holds scans of this laser: lasers with different fields of view share no
  /// walls.
  [[nodiscard]] bool has_laser(LaserId laser) const { return keyframes_.contains(laser); }

  /// Share of the points, of this scan and of its laser's last keyframe, that would lie in the free
  /// space observed by the other if the body were at this pose.
  [[nodiscard]] double contradiction_share(const ScanObservation& observation,
                                           const Pose2& T_odom_body) const;

  /// Whether the wall nearest to a point was observed in one place at different heights.
  [[nodiscard]] bool is_steep_at(const SurfacePoint& point_body, const Pose2& T_odom_body) const;

  /// Adds the scan if the body has moved enough since the last keyframe of its laser.
  /// `ground_apart`: its points that may be ground or roof do not count for matches, only for
  /// whether they are steep.
  void add_keyframe(ScanObservation observation, const Pose2& T_odom_body, double odometer_m,
                    bool ground_apart = false);

  /// Resets the keyframe of the scan's laser to this scan; surfels of all lasers are kept.
  void reset_laser(ScanObservation observation, const Pose2& T_odom_body, double odometer_m);

  /// Clears the reference and starts again with this scan.
  void reset(ScanObservation observation, const Pose2& T_odom_body, double odometer_m);

 private:
  struct Keyframe {
    ScanObservation observation;
    Pose2 T_odom_body;
  };

  void insert(ScanObservation observation, const Pose2& T_odom_body, double odometer_m,
              bool ground_apart = false);

  LocalReferenceParams params_;
  SurfelMap surfels_;
  SurfelMap apart_;  ///< what may be ground or roof, drawn where the place was not sure
  std::map<LaserId, Keyframe> keyframes_;
  double forget_at_m_ = 0.0;  ///< odometer reading of the next removal
};

}  // namespace adit

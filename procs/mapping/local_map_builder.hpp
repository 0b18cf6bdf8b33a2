// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <string>

#include "common/config/bounds.hpp"
#include "common/sensing/scan_match.hpp"
#include "common/types/local_map.hpp"
#include "procs/mapping/association/odometry_chain.hpp"
#include "procs/mapping/displacement_error.hpp"

namespace adit {

struct LocalMapBuilderParams {
  double length_m = 5.0;             ///< way in a local map (paper, section 2.1)
  double turn_max_rad = 6.3;         ///< and turning, after which it is finished, however short
  double keyframe_distance_m = 0.1;  ///< a scan is kept after this motion of its laser
  double keyframe_angle_rad = 0.1;   ///< or this turn
  double first_s = 0.5;  ///< after which the first of a later session is finished, at rest
  DisplacementErrorParams error;

  template <class V>
  void visit(V& v) {
    v("length_m", length_m, within(0.1, 1000.0));
    v("turn_max_rad", turn_max_rad, within(0.1, 1000.0));
    v("keyframe_distance_m", keyframe_distance_m, at_least(0.0));
    v("keyframe_angle_rad", keyframe_angle_rad, at_least(0.0));
    v("first_s", first_s, within(0.0, 60.0));
    v("error", error);
  }
};

/// Cuts the way into local maps (paper, section 2.1). Way and turning are measured between kept
/// scans, so that a body at rest makes no maps. The last scan of a local map is the first of the
/// next. Where scan matching begins a new odom frame, the map at hand is finished and a new session
/// begins. The first local map of a session that continues a map is a short one, of what is seen
/// from where the body stands, so that it can be found on the map before it moves.
class LocalMapBuilder {
 public:
  /// `first_id`, `session`: of the first local map; others than 0 where earlier ones are known.
  explicit LocalMapBuilder(const LocalMapBuilderParams& params, int first_id = 0, int session = 0);

  /// Takes a scan and what scan matching made of it; in order of time. The local map that this
  /// finishes, if it does. Scans that were lost are not kept, but the way goes on; refused ones
  /// change nothing.
  std::optional<LocalMap> add(const std::string& channel, const LaserScan& scan,
                              const ScanMatch& match);

  /// The unfinished local map, where it holds a scan at all, and its information as of now. What
  /// comes afterwards is a new session.
  std::optional<LocalMap> finish();

  /// The local map that was finished last is not kept: the one at hand takes its place, and hangs
  /// on the one before, from which this is where it begins.
  void replace_last_map(const UncertainPose& T_before_last);

  /// The local map at hand; without scans before the first and after `finish`.
  [[nodiscard]] const LocalMap& current() const { return map_; }
  /// Covariance of the body's last pose in the frame of the local map at hand: of (x, y, θ) in the
  /// body frame.
  [[nodiscard]] Eigen::Matrix3d covariance_local_body() const { return error_.covariance(); }

 private:
  [[nodiscard]] bool first_map_due(std::int64_t utime) const;
  [[nodiscard]] bool moved_enough(const std::string& channel, const Pose2& T_odom_body) const;
  void store_scan(const std::string& channel, const LaserScan& scan, const Pose2& T_odom_body);
  void begin(const Pose2& T_odom_local);
  LocalMap end();

  LocalMapBuilderParams params_;
  DisplacementError error_;
  LocalMap map_;
  std::optional<std::int64_t> odom_epoch_utime_;  ///< when the odom frame began
  Pose2 T_odom_body_;                             ///< of the last match
  Pose2 T_odom_stored_;                           ///< of the last kept scan, of whichever laser
  std::map<std::string, Pose2> last_stored_;      ///< T_odom_body of the last kept scan, by channel
  double distance_travelled_m_ = 0.0;
  double turn_rad_ = 0.0;
  bool continues_ = false;  ///< the local map at hand is the first of a later session
};

}  // namespace adit

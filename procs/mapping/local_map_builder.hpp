// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "common/config/bounds.hpp"
#include "common/sensing/scan_match.hpp"
#include "common/types/local_map.hpp"
#include "procs/mapping/association/odometry_chain.hpp"
#include "procs/mapping/displacement_error.hpp"
#include "procs/mapping/loop_closure/local_walls.hpp"
#include "procs/mapping/wheel_steps.hpp"

namespace adit {

struct LocalMapBuilderParams {
  double length_m = 5.0;      ///< path length of a local map (paper, section 2.1)
  double turn_max_rad = 6.3;  ///< accumulated turn after which it is finished, however short
  /// A 3D scan begins a new local map if the current one has this path length, so that matches of
  /// 3D scans relate local maps without the error of the path between.
  double split_min_m = 1.0;
  double keyframe_distance_m = 0.1;  ///< a scan is stored after this motion of its laser
  double keyframe_angle_rad = 0.1;   ///< or this turn
  double first_s = 0.5;  ///< duration of the first local map of a later session, for a body at rest
  DisplacementErrorParams error;

  template <class V>
  void visit(V& v) {
    v("length_m", length_m, within(0.1, 1000.0));
    v("turn_max_rad", turn_max_rad, within(0.1, 1000.0));
    v("split_min_m", split_min_m, within(0.0, 1000.0));
    v("keyframe_distance_m", keyframe_distance_m, at_least(0.0));
    v("keyframe_angle_rad", keyframe_angle_rad, at_least(0.0));
    v("first_s", first_s, within(0.0, 60.0));
    v("error", error);
  }
};

/// Splits the traversed path into local maps (paper, section 2.1). Path length and turn are
/// measured between stored scans, so that a standing body makes no maps. A 3D scan begins a local
/// map as well. The last scan of a local map is the first of the next. When scan matching starts a
/// new odom frame, the current map is finished and a new session begins. The first local map of a
/// session that continues a map is short, from what is observed at the start, so that it can be
/// localised before the body moves.
class LocalMapBuilder {
 public:
  /// `mounts`: of lasers whose scans are corrected for the motion of the body if they take long
  /// (`without_motion`). `first_id`, `session`: of the first local map; not 0 if earlier maps
  /// exist.
  explicit LocalMapBuilder(const LocalMapBuilderParams& params, LaserMounts mounts = {},
                           int first_id = 0, int session = 0);

  /// Adds a reading of the wheels, with which the displacements by scan matching are compared.
  void add(const WheelOdometry& reading) { wheels_.add(reading); }

  /// The clock of all sensors was set: times so far cannot be compared with those to come.
  void restart_time() { wheels_.clear(); }

  /// Adds a scan and its scan match, in order of time. Returns the local map that this finishes, if
  /// any. Lost scans are not stored, but their motion counts; rejected scans are ignored.
  std::optional<LocalMap> add(const std::string& channel, const LaserScan& scan,
                              const ScanMatch& match);

  /// Without 3D scans all surfaces are walls. Now there are some, which tell ground and walls
  /// apart: unconfirmed beams are not taken for walls any more. Nor are those before the first 3D
  /// scan, if that is made where the local map begins.
  void expect_ground();

  /// The body stands where a 3D scan was taken: the next scan that matches ends the current local
  /// map, unless that is too short.
  void begin_at_next_scan() { due_ = true; }

  /// Finishes the current local map, if it holds a scan. What follows is a new session.
  std::optional<LocalMap> finish();

  /// Replaces the last finished local map, which is discarded, by the current one: links the
  /// current map to the one before, in which it begins at `T_before_last`.
  void replace_last_map(const UncertainPose& T_before_last, const LocalMap& discarded);

  /// Signed distance travelled forwards in the current local map [m].
  [[nodiscard]] double forward_m() const { return forward_m_; }
  /// The current local map; without scans before the first scan and after `finish`.
  [[nodiscard]] const LocalMap& current() const { return map_; }
  /// Of the displacements that end at local maps of this builder, by their ids, in their frames.
  [[nodiscard]] const std::map<int, WheelScaleError>& wheel_scale_errors() const {
    return scale_errors_;
  }
  /// Of the body's last pose in the frame of the current local map, in the body frame.
  [[nodiscard]] WheelScaleError wheel_scale_error_body() const {
    return error_.wheel_scale_error();
  }
  /// Covariance of the body's last pose in the frame of the current local map: of (x, y, θ) in the
  /// body frame.
  [[nodiscard]] Eigen::Matrix3d covariance_local_body() const { return error_.covariance(); }

 private:
  [[nodiscard]] bool first_map_due(std::int64_t utime) const;
  [[nodiscard]] bool split_due();
  [[nodiscard]] bool moved_enough(const std::string& channel, const Pose2& T_odom_body) const;
  [[nodiscard]] LocalScan local_scan(const std::string& channel, const LaserScan& scan,
                                     const ScanMatch& match) const;
  void store_scan(const std::string& channel, const LaserScan& scan, const ScanMatch& match);
  void begin(const Pose2& T_odom_local);
  LocalMap end();

  LocalMapBuilderParams params_;
  LaserMounts mounts_;
  DisplacementError error_;
  WheelSteps wheels_;
  LocalMap map_;
  std::map<int, WheelScaleError> scale_errors_;   ///< by the local map where the displacement ends
  std::optional<std::int64_t> odom_epoch_utime_;  ///< when the odom frame began
  Pose2 T_odom_body_;                             ///< of the last match
  Pose2 T_odom_stored_;                           ///< of the last stored scan, of any laser
  std::map<std::string, Pose2> last_stored_;  ///< T_odom_body of the last stored scan, by channel
  double distance_travelled_m_ = 0.0;
  double forward_m_ = 0.0;  ///< travelled forwards in the current local map
  double turn_rad_ = 0.0;
  bool sees_ground_ = false;
  /// Of the scans of the current local map, their unconfirmed beams; until `sees_ground_`.
  std::vector<std::vector<std::int32_t>> withheld_;
  bool due_ = false;        ///< to end with the next scan
  bool continues_ = false;  ///< the current local map is the first of a later session
};

}  // namespace adit

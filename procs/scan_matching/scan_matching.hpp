// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <vector>

#include <Eigen/Core>

#include "common/config/bounds.hpp"
#include "common/registration/degeneracy.hpp"
#include "common/registration/surface_points.hpp"
#include "common/sensing/laser_mount.hpp"
#include "common/sensing/laser_scan.hpp"
#include "common/sensing/laser_tilt.hpp"
#include "common/sensing/match_doubt.hpp"
#include "common/sensing/scan_match.hpp"
#include "common/types/cloud.hpp"
#include "common/types/terrain_map.hpp"
#include "common/types/vehicle.hpp"
#include "procs/scan_matching/chain_doubt.hpp"
#include "procs/scan_matching/ground/body_attitude.hpp"
#include "procs/scan_matching/ground/ground_attitude.hpp"
#include "procs/scan_matching/ground/known_ground.hpp"
#include "procs/scan_matching/local_reference.hpp"
#include "procs/scan_matching/motion/laser_disagreement.hpp"
#include "procs/scan_matching/motion/motion_prediction.hpp"
#include "procs/scan_matching/motion/standstill.hpp"
#include "procs/scan_matching/motion/wheel_scale.hpp"
#include "procs/scan_matching/pose_search.hpp"

namespace adit {

struct ScanMatchingParams {
  Lasers lasers;
  Vehicle vehicle;
  SurfaceParams surface;
  MotionPredictionParams motion;
  WheelScaleParams wheel_scale;
  BodyAttitudeParams attitude;
  GroundAttitudeParams ground_attitude;
  LocalReferenceParams reference;
  LaserDisagreementParams disagreement;
  PoseSearchParams search;
  StandstillParams standstill;
  DegeneracyParams degeneracy;
  ChainDoubtParams doubt;
  int points_min = 20;             ///< minimum number of points of a scan
  double lost_score = 0.4;         ///< minimum score of an accepted match,
  double inlier_share_min = 0.25;  ///< and its minimum share of inliers
  int lost_max = 3;  ///< consecutive lost scans, of a laser or of all, before the reference of this
                     ///< laser, or of all, is reset
  /// Scans of a laser with a larger tilt are ignored; scan_assembly uses them. And so are those of
  /// a laser whose tilt still changes: what leans ahead seems to move, by 4 cm a scan on a slope.
  LevelTilt level_tilt{.angle_max_rad = 0.03, .rate_max_rad_s = 0.05};
  bool lasers_tilt = false;  ///< scans are ignored until the tilt of their laser is known

  template <class V>
  void visit(V& v) {
    v.shared(Lasers::kSection, lasers);
    v.shared(Vehicle::kSection, vehicle);
    v("surface", surface);
    v("motion", motion);
    v("wheel_scale", wheel_scale);
    v("attitude", attitude);
    v("ground_attitude", ground_attitude);
    v("reference", reference);
    v("disagreement", disagreement);
    v("search", search);
    v("standstill", standstill);
    v("degeneracy", degeneracy);
    v("doubt", doubt);
    v("points_min", points_min, at_least(3));
    v("lost_score", lost_score, within(0.0, 1.0));
    v("inlier_share_min", inlier_share_min, within(0.0, 1.0));
    v("lost_max", lost_max, at_least(1));
    v("tilt_max_rad", level_tilt.angle_max_rad, above(0.0));
    v("tilt_rate_max_rad_s", level_tilt.rate_max_rad_s, above(0.0));
    v("lasers_tilt", lasers_tilt);
  }
};

/// Incremental scan matching: each scan is matched against the walls observed over the last metres
/// of the traversed path (paper, section 2.1; Lu and Milios, "Robot pose estimation in unknown
/// environments by matching 2D range scans", 1997; Censi 2008; Olson 2009). Wheel odometry and
/// gyro, where available, are a prior. In a direction that the scan does not constrain they replace
/// it, otherwise the last speed does, and the result reports this.
class ScanMatching {
 public:
  explicit ScanMatching(const ScanMatchingParams& params);

  /// False: the reading does not advance in time and is ignored.
  bool add(const WheelOdometry& reading);
  bool add(const ImuReading& reading);
  /// A 3D scan, made where the body stands, levelled by the attitude of POSE without an IMU.
  void add(const Cloud& cloud);
  /// A terrain map of the last 3D scan, made where the body stands.
  void add(TerrainMap terrain);

  /// Estimates the pose of the body in odom at the time of the scan. Odom starts at the first scan.
  /// A scan that does not advance in time, of its laser or of the body, is rejected. A scan that is
  /// empty or matches nothing is lost: the pose is the prediction.
  ScanMatch add_scan(LaserId laser, const LaserScan& scan);

  /// The clock of all sensors was set: times so far cannot be compared with those to come. The next
  /// scan counts as made 3 s after the last one.
  void restart_time();

  /// Why the motion to the last scan may be wrong; empty if it is sure.
  [[nodiscard]] const std::optional<MatchDoubt>& doubt() const { return doubt_; }

 private:
  [[nodiscard]] std::optional<Attitude> attitude() const;
  [[nodiscard]] const LaserMount& mount_of(LaserId laser) const;
  [[nodiscard]] Eigen::Vector3d velocity(std::int64_t utime, const MotionEstimate& expected) const;
  [[nodiscard]] ScanObservation observe(LaserId laser, const LaserScan& scan,
                                        const Pose2& T_odom_expected) const;
  [[nodiscard]] ScanMatch rejected(std::int64_t utime) const;
  [[nodiscard]] std::vector<std::int32_t> unconfirmed_beams(const ScanObservation& observation,
                                                            const Pose2& T_odom_body) const;
  [[nodiscard]] double climb_m(const ScanMatch& match) const;
  void compare_with_wheels(const ScanMatch& match, const MotionEstimate& expected,
                           double level_share);
  [[nodiscard]] bool advances_in_time(LaserId laser, std::int64_t utime) const;
  PoseSearchResult locate(const ScanObservation& observation, const MotionEstimate& expected,
                          ScanMatch& match);
  void accept_match(LaserId laser, const PoseCandidate& best, const MotionEstimate& expected,
                    double lever_arm_m, ScanMatch& match);
  void shift_time_to(std::int64_t utime);
  void advance(ScanObservation observation, const ScanMatch& match);
  void update_odometer();
  void update_reference(ScanObservation observation, const ScanMatch& match);

  ScanMatchingParams params_;
  MotionPrediction motion_;
  WheelScale wheel_scale_;
  std::optional<Pose2> T_odom_measured_;  ///< at the last scan that measured the motion
  Pose2 wheels_since_measured_;
  BodyAttitude attitude_;
  GroundAttitude ground_attitude_;  ///< without an IMU
  KnownGround ground_;
  LocalReference reference_;
  LaserDisagreement disagreement_;
  PoseSearch search_;
  Standstill standstill_;
  ChainDoubt chain_doubt_;
  std::optional<MatchDoubt> doubt_;
  std::map<LaserId, std::int64_t> last_scan_utime_;
  std::int64_t odom_epoch_utime_ = 0;  ///< of the first scan
  std::int64_t utime_ = 0;
  bool time_restarts_ = false;  ///< with the next scan
  Pose2 T_odom_body_;
  /// Of the last pose in the reference.
  Eigen::Matrix3d reference_covariance_ = Eigen::Matrix3d::Zero();
  double z_m_ = 0.0;  ///< height of the body in odom
  double odometer_m_ = 0.0;
  Pose2 T_odom_counted_;  ///< pose at the last update of the odometer
  double typical_score_ = 0.5;
  int lost_in_a_row_ = 0;  ///< of all lasers together
  std::map<LaserId, int> lost_in_a_row_of_;
};

}  // namespace adit

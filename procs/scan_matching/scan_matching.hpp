// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <map>
#include <optional>

#include <Eigen/Core>

#include "common/config/bounds.hpp"
#include "common/registration/degeneracy.hpp"
#include "common/registration/surface_points.hpp"
#include "common/sensing/laser_mount.hpp"
#include "common/sensing/laser_scan.hpp"
#include "common/sensing/scan_match.hpp"
#include "procs/scan_matching/body_tilt.hpp"
#include "procs/scan_matching/local_reference.hpp"
#include "procs/scan_matching/motion_prediction.hpp"
#include "procs/scan_matching/pose_search.hpp"
#include "procs/scan_matching/standstill.hpp"

namespace adit {

struct ScanMatchingParams {
  Lasers lasers;
  SurfaceParams surface;
  MotionPredictionParams motion;
  BodyTiltParams body_tilt;
  LocalReferenceParams reference;
  PoseSearchParams search;
  StandstillParams standstill;
  DegeneracyParams degeneracy;
  int points_min = 20;             ///< a scan with fewer is not matched
  double lost_score = 0.4;         ///< a match with less is not believed,
  double inlier_share_min = 0.25;  ///< nor one that rests on fewer of the points
  int lost_max = 3;  ///< scans in a row, of a laser or of all, without a match before the
                     ///< reference of this laser, or of all, starts anew
  double tilt_max_rad =
      0.03;                  ///< scans of a laser that is tilted by more are left to scan_assembly
  bool lasers_tilt = false;  ///< then scans count only once it is known how far

  template <class V>
  void visit(V& v) {
    v.shared(Lasers::kSection, lasers);
    v("surface", surface);
    v("motion", motion);
    v("body_tilt", body_tilt);
    v("reference", reference);
    v("search", search);
    v("standstill", standstill);
    v("degeneracy", degeneracy);
    v("points_min", points_min, at_least(3));
    v("lost_score", lost_score, within(0.0, 1.0));
    v("inlier_share_min", inlier_share_min, within(0.0, 1.0));
    v("lost_max", lost_max, at_least(1));
    v("tilt_max_rad", tilt_max_rad, above(0.0));
    v("lasers_tilt", lasers_tilt);
  }
};

/// Motion from planar scans alone, incrementally: each scan is matched against the walls seen over
/// the last metres of the way (paper, section 2.1; Lu and Milios, "Robot pose estimation in unknown
/// environments by matching 2D range scans", 1997; Censi 2008; Olson 2009). Wheel odometry and
/// gyro, where there are any, are a prior; in a direction that the scan leaves open they stand in
/// for it, otherwise the last speed does, and the result says so.
class ScanMatching {
 public:
  explicit ScanMatching(const ScanMatchingParams& params);

  /// False where the reading does not advance in time; it is then not used.
  bool add(const WheelOdometry& reading) { return motion_.add(reading); }
  bool add(const ImuReading& reading);

  /// Estimates the pose of the body in odom at the time of the scan. Odom begins at the first scan.
  /// A scan that does not advance in time, of its laser or of the body, is refused; a scan that is
  /// empty or fits nothing is lost: the pose is then the prediction.
  ScanMatch add_scan(LaserId laser, const LaserScan& scan);

 private:
  [[nodiscard]] ScanObservation observe(LaserId laser, const LaserScan& scan) const;
  void locate(const ScanObservation& observation, ScanMatch& match);
  void accept_match(const PoseCandidate& best, const MotionEstimate& expected, double lever_arm_m,
                    ScanMatch& match);
  void advance(ScanObservation observation, const ScanMatch& match);
  void update_odometer();
  void update_reference(ScanObservation observation, const ScanMatch& match);

  ScanMatchingParams params_;
  MotionPrediction motion_;
  BodyTilt tilt_;
  LocalReference reference_;
  PoseSearch search_;
  Standstill standstill_;
  std::map<LaserId, std::int64_t> last_scan_utime_;
  std::int64_t odom_epoch_utime_ = 0;  ///< of the first scan
  std::int64_t utime_ = 0;
  Pose2 T_odom_body_;
  Eigen::Matrix3d reference_covariance_ = Eigen::Matrix3d::Zero();  ///< of the last pose in it
  double odometer_m_ = 0.0;
  Pose2 T_odom_counted_;  ///< up to where the odometer has counted
  double typical_score_ = 0.5;
  int lost_in_a_row_ = 0;  ///< of all lasers together
  std::map<LaserId, int> lost_in_a_row_of_;
};

}  // namespace adit

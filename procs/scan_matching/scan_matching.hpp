// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include <Eigen/Core>

#include "common/registration/correlative_search.hpp"
#include "common/registration/free_space.hpp"
#include "common/registration/point_to_line.hpp"
#include "common/registration/surface_points.hpp"
#include "common/registration/surfel_map.hpp"
#include "common/sensing/laser_mount.hpp"
#include "common/sensing/laser_scan.hpp"
#include "procs/scan_matching/motion_prediction.hpp"

namespace adit {

struct ScanMatchingParams {
  LaserMount laser_front;
  LaserMount laser_rear{{0.0, 0.0, 3.1415926535897931}};
  SurfaceParams surface;
  SurfelMapParams reference;
  PointToLineParams point_to_line;
  CorrelativeSearchParams correlative_search;
  MotionPredictionParams motion;
  int points_min = 20;                ///< a scan with fewer is not matched
  double trusted_inlier_share = 0.6;  ///< a match with less is doubted: the search is asked
  double lost_inlier_share = 0.4;     ///< and with less than this after it, not believed
  double search_motion_m = 0.3;       ///< expected steps above this are searched at once
  double search_motion_rad = 0.35;
  double prior_weight = 0.125;
  double narrow_m = 0.08;
  double peak_scale_m = 0.2;
  double doubt_margin = 0.1;
  double unseen_credit = 0.5;
  double surprise_m = 0.05;
  double surprise_rad = 0.05;
  double search_radius_m = 1.0;  ///< half-width of the search
  double search_angle_rad = 0.7;
  double wide_score = 0.6;
  double wide_radius_m = 2.5;
  double wide_angle_rad = 2.5;
  double contradiction_margin_m = 0.3;
  double keyframe_distance_m = 0.1;  ///< a scan joins the reference after this motion
  double keyframe_angle_rad = 0.1;
  double memory_m = 15.0;         ///< walls not seen for this path length are forgotten
  double degenerate_ratio = 4.0;  ///< information below this times its spurious part is none
  double degenerate_sd_m = 0.15;  ///< nor is one that leaves this much uncertainty
  int lost_max = 3;               ///< scans in a row without a match before a fresh start
};

enum class MatchStatus {
  kFirstScan,  ///< nothing to match against yet; the pose is where odom begins
  kMatched,
  kLost,     ///< no trusted match; the pose is the prediction
  kRefused,  ///< time did not advance; nothing was changed
};

enum class FilledBy { kNothing, kOdometry, kGyro };

/// A direction of motion that the scan says nothing about.
struct DegenerateDirection {
  Eigen::Vector3d direction;  ///< unit vector of (x [m], y [m], θ [rad] times lever arm [m]), body
  FilledBy filled_by = FilledBy::kNothing;
};

struct ScanMatch {
  std::int64_t utime = 0;            ///< of this scan [µs]
  std::int64_t reference_utime = 0;  ///< of the scan before it [µs]
  MatchStatus status = MatchStatus::kRefused;
  Pose2 T_odom_body;
  Pose2 T_reference_body;  ///< motion since reference_utime
  /// Of T_reference_body as (x, y, θ) in the body frame at utime.
  Eigen::Matrix3d covariance = Eigen::Matrix3d::Zero();
  double inlier_share = 0.0;    ///< of the scan's points
  double rms_residual_m = 0.0;  ///< of the inliers
  double contradiction = 0.0;
  double score = 0.0;
  std::vector<DegenerateDirection> degenerate;
  int points = 0;
  int iterations = 0;
  bool searched = false;  ///< the correlative search was asked
};

/// Motion from planar scans alone, incrementally: each scan is matched against the walls seen in
/// the last metres of the way (paper, section 2.1; Lu & Milios 1997; Censi 2008; Olson 2009).
/// Wheel odometry and gyro, where there are any, are a prior and fill directions that the scans
/// leave open; nothing else is made up.
class ScanMatching {
 public:
  explicit ScanMatching(const ScanMatchingParams& params);

  bool add(const WheelOdometry& reading) { return motion_.add(reading); }
  bool add(const ImuReading& reading) { return motion_.add(reading); }

  /// Estimates the pose of the body at the time of the scan.
  ScanMatch add_scan(const LaserMount& mount, const LaserScan& scan);

  [[nodiscard]] const ScanMatchingParams& params() const { return params_; }

 private:
  struct Sighting {
    std::vector<SurfacePoint> points;
    FreeSpace space;
  };
  struct Candidate {
    PointToLineResult match;
    double contradiction = 0.0;
    double score = 0.0;
    double surprise = 0.0;
  };
  Candidate refine(const Sighting& sighting, const Pose2& start, const PosePrior& prior,
                   double scale) const;
  Candidate match(const Sighting& sighting, const MotionEstimate& expected, ScanMatch& out);
  void remember(const Sighting& sighting, const ScanMatch& match);
  void set_keyframe(const Sighting& sighting);

  ScanMatchingParams params_;
  MotionPrediction motion_;
  SurfelMap reference_;
  std::int64_t utime_ = 0;
  bool started_ = false;
  Pose2 T_odom_body_;
  Pose2 T_odom_keyframe_;
  std::vector<SurfacePoint> keyframe_points_;
  FreeSpace keyframe_space_;
  double odometer_m_ = 0.0;
  int lost_ = 0;
  double typical_ = 0.5;
};

}  // namespace adit

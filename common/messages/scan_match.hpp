// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include <Eigen/Core>

#include "adit/scan_match_t.hpp"

#include "common/geometry/pose2.hpp"
#include "common/messages/result.hpp"

namespace adit {

/// A direction in which a scan says nothing, and what stood in for the scan there.
struct DegenerateDirection {
  enum class Fill : std::int8_t {
    kNone = scan_match_t::FILL_NONE,
    kOdometry = scan_match_t::FILL_ODOMETRY,
    kImu = scan_match_t::FILL_IMU,
  };
  Eigen::Vector3d direction = Eigen::Vector3d::Zero();  ///< unit; x, y [m], theta scaled to m
  Fill fill = Fill::kNone;

  friend bool operator==(const DegenerateDirection&, const DegenerateDirection&) = default;
};

/// What scan matching made of one scan, as it goes onto channel SCAN_MATCH.
struct ScanMatchReport {
  enum class Status : std::int8_t {
    kFirstScan = scan_match_t::STATUS_FIRST_SCAN,
    kMatched = scan_match_t::STATUS_MATCHED,
    kLost = scan_match_t::STATUS_LOST,
    kRefused = scan_match_t::STATUS_REFUSED,
  };

  std::int64_t utime = 0;            ///< of the scan [µs since the epoch]
  std::int64_t reference_utime = 0;  ///< of the previous matched scan, 0 for the first
  std::string channel;               ///< on which the scan came
  Status status = Status::kFirstScan;
  Pose2 T_odom_body;
  Pose2 delta;  ///< pose of body at `utime` in body at `reference_utime`
  Eigen::Matrix3d covariance = Eigen::Matrix3d::Zero();  ///< of delta, from the match [m, m, rad]
  double inlier_share = 0.0;                             ///< 0 to 1
  double rms_residual_m = 0.0;
  std::vector<DegenerateDirection> degenerate;
  std::int32_t iterations = 0;
  bool searched = false;
  std::int32_t points = 0;

  friend bool operator==(const ScanMatchReport&, const ScanMatchReport&) = default;
};

scan_match_t to_message(const ScanMatchReport& report);

/// Refused: implausible times, an unknown status or fill, a pose, covariance or direction that is
/// not finite, more than three degenerate directions.
Result<ScanMatchReport> from_message(const scan_match_t& message);

}  // namespace adit

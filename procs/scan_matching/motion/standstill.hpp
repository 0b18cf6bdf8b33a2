// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <map>
#include <optional>

#include "common/config/bounds.hpp"
#include "common/geometry/pose2.hpp"
#include "common/sensing/laser_scan.hpp"
#include "common/sensing/scan_match.hpp"
#include "procs/scan_matching/motion/motion_prediction.hpp"

namespace adit {

struct StandstillParams {
  double refute_m = 0.05;          ///< a match this far from the first one of its laser contradicts
  double refute_rad = 0.03;        ///< the standstill, as does one turned by this;
  int refute_scans = 5;            ///< this many consecutive contradictions refute the standstill
  double sd_m_per_sqrt_s = 0.005;  ///< motion of a standing body
  double sd_rad_per_sqrt_s = 0.002;

  template <class V>
  void visit(V& v) {
    v("refute_m", refute_m, above(0.0));
    v("refute_rad", refute_rad, above(0.0));
    v("refute_scans", refute_scans, at_least(1));
    v("sd_m_per_sqrt_s", sd_m_per_sqrt_s, above(0.0));
    v("sd_rad_per_sqrt_s", sd_rad_per_sqrt_s, above(0.0));
  }
};

/// Holds the pose in odom while the wheels measure a standstill. Scans alone would let it drift:
/// they leave directions unconstrained, and two lasers agree on a place only up to their mount
/// errors, or where one takes rising ground for a wall up to centimetres. Motion moves the matches
/// of a laser against its own first one. If consecutive scans contradict the standstill (wheels
/// blocked on a slope, a broken encoder), the scans are used until the wheels have moved again.
class Standstill {
 public:
  explicit Standstill(const StandstillParams& params) : params_(params) {}

  /// Replaces the pose and the covariance of the match by those of the standstill, if the body
  /// stands.
  void apply(LaserId laser, const MotionEstimate& expected, ScanMatch& match);

 private:
  [[nodiscard]] bool refuted_by(LaserId laser, const ScanMatch& match);

  StandstillParams params_;
  std::optional<Pose2> T_odom_body_;      ///< pose of the standstill
  std::map<LaserId, Pose2> first_match_;  ///< T_odom_body of each laser in it
  int contradicting_scans_ = 0;           ///< consecutive scans that contradict it
};

}  // namespace adit

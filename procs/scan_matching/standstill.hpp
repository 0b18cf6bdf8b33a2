// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>

#include "common/config/bounds.hpp"
#include "common/geometry/pose2.hpp"
#include "common/sensing/scan_match.hpp"
#include "procs/scan_matching/motion_prediction.hpp"

namespace adit {

struct StandstillParams {
  double refute_m = 0.05;    ///< a match this far from where the body stands speaks against it,
  double refute_rad = 0.03;  ///< as does one turned by this,
  int refute_scans = 5;      ///< and so many of them in a row refute it
  double sd_m_per_sqrt_s = 0.005;  ///< of what a body that stands still moves
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

/// A body that stands by its wheels stays where it is in odom. Scans alone let it creep: they leave
/// directions open, and two lasers agree on a place only up to their offsets. Scans that keep
/// saying otherwise (wheels that are blocked on a slope, a broken encoder) are believed, until the
/// wheels have moved again.
class Standstill {
 public:
  explicit Standstill(const StandstillParams& params) : params_(params) {}

  /// Puts the pose of the match, and its covariance, to what standing says, if the body stands.
  void apply(const MotionEstimate& expected, ScanMatch& match);

 private:
  [[nodiscard]] bool refuted_by(const ScanMatch& match);

  StandstillParams params_;
  std::optional<Pose2> T_odom_body_;  ///< where it stands
  int contradicting_scans_ = 0;       ///< scans in a row that say otherwise
};

}  // namespace adit

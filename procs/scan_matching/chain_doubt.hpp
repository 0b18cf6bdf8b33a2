// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "common/config/bounds.hpp"
#include "common/sensing/match_doubt.hpp"
#include "common/sensing/scan_match.hpp"
#include "procs/scan_matching/motion/motion_prediction.hpp"
#include "procs/scan_matching/pose_search.hpp"

namespace adit {

struct ChainDoubtParams {
  double poor_score = 0.48;  ///< a match with a lower score may be by chance,
  double weak_score = 0.6;   ///< one with a lower score may be if others are near:
  double weak_margin = 0.3;  ///< within this score
  double margin = 0.12;      ///< a pose within this score is as likely as the best
  double distinct_m = 0.5;   ///< closer poses are the same
  double distinct_rad = 0.2;
  double acceleration_max_m_s2 = 0.5;  ///< mean between two scans; bounds the poses they admit
  double unobserved_max_m = 1.0;       ///< path length with an unobserved direction
  double unlocated_max_m = 5.0;        ///< path length by the wheels alone, of lost scans or none
  double contradicted_sigmas = 10.0;   ///< between a poor match and the sensors
  /// Without wheels: a gap between scans that is so many times longer than usual, and during which
  /// the body moved farther, is bridged by one match alone.
  double gap_intervals = 10.0;
  double gap_moved_max_m = 0.5;

  template <class V>
  void visit(V& v) {
    v("poor_score", poor_score, within(0.0, 1.0));
    v("weak_score", weak_score, within(0.0, 1.0));
    v("weak_margin", weak_margin, within(0.0, 1.0));
    v("margin", margin, within(0.0, 1.0));
    v("distinct_m", distinct_m, above(0.0));
    v("distinct_rad", distinct_rad, above(0.0));
    v("acceleration_max_m_s2", acceleration_max_m_s2, above(0.0));
    v("unobserved_max_m", unobserved_max_m, above(0.0));
    v("unlocated_max_m", unlocated_max_m, above(0.0));
    v("contradicted_sigmas", contradicted_sigmas, above(0.0));
    v("gap_intervals", gap_intervals, above(1.0));
    v("gap_moved_max_m", gap_moved_max_m, above(0.0));
  }
};

/// Judges each motion of the chain of scan matches: which of them may be wrong? One that the wheels
/// measured, over a few metres, or that leads nowhere beyond the search around the prediction, is
/// sure. Of the others
/// the evidence decides: the score of the match, and by how much it exceeds that of all other poses
/// that the body can have reached (Olson, "Real-time correlative scan matching", ICRA 2009, takes
/// the covariance from the same scores; at several peaks it says nothing).
class ChainDoubt {
 public:
  explicit ChainDoubt(const ChainDoubtParams& params) : params_(params) {}

  /// To be called for each scan with a pose, in order of time. `lost_score`: minimum score of a
  /// match.
  std::optional<MatchDoubt> judge(const ScanMatch& match, const MotionEstimate& expected,
                                  const PoseSearchResult& found);

  /// Moves the times of earlier scans.
  void shift_time(std::int64_t shift_us);

 private:
  [[nodiscard]] std::optional<MatchDoubt::Reason> reason(
      const ScanMatch& match, const MotionEstimate& expected, const PoseSearchResult& found,
      const std::vector<MatchDoubt::Alternative>& others) const;
  [[nodiscard]] std::vector<MatchDoubt::Alternative> distinct(const MotionEstimate& expected,
                                                              const PoseSearchResult& found) const;
  [[nodiscard]] bool is_gap(const ScanMatch& match, const MotionEstimate& expected) const;
  void add_interval(const ScanMatch& match, const MotionEstimate& expected);
  void add_unobserved(const ScanMatch& match);
  void add_unlocated(const ScanMatch& match);

  ChainDoubtParams params_;
  std::int64_t located_utime_ = 0;          ///< of the last scan that was located
  double unlocated_m_ = 0.0;                ///< path length since then
  double interval_s_ = 0.0;                 ///< between scans that were located, on average
  double unobserved_m_ = 0.0;               ///< path length of the current stretch,
  std::int64_t unobserved_from_utime_ = 0;  ///< and its beginning
};

}  // namespace adit

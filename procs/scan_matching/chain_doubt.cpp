// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "procs/scan_matching/chain_doubt.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "common/geometry/pose2.hpp"

namespace adit {
namespace {

using Alternative = MatchDoubt::Alternative;
using Reason = MatchDoubt::Reason;

constexpr double kAlternativesMargin = 0.15;  // alternatives within this score are told
constexpr std::size_t kAlternativesMax = 5;
constexpr double kIntervalShare = 0.1;  // weight of a new interval in the running mean

bool is_near(const Pose2& a, const Pose2& b, double distance_m, double angle_rad) {
  const Pose2 apart = between(a, b);
  return apart.translation().norm() <= distance_m && std::abs(apart.theta) <= angle_rad;
}

}  // namespace

void ChainDoubt::shift_time(std::int64_t shift_us) {
  located_utime_ += shift_us;
  unobserved_from_utime_ += shift_us;
}

std::optional<MatchDoubt> ChainDoubt::judge(const ScanMatch& match, const MotionEstimate& expected,
                                            const PoseSearchResult& found) {
  add_unobserved(match);
  add_unlocated(match);
  const bool after_gap = is_gap(match, expected);
  add_interval(match, expected);
  std::vector<Alternative> others = distinct(expected, found);
  std::optional<Reason> why = reason(match, expected, found, others);
  if (!why && after_gap) why = Reason::kLost;
  const std::int64_t from_utime = why == Reason::kDegenerate ? unobserved_from_utime_
                                  : why == Reason::kLost     ? located_utime_
                                                             : match.reference_utime;
  if (match.status != ScanMatch::Status::kLost) located_utime_ = match.utime;
  if (!why) return std::nullopt;
  std::erase_if(others, [&](const Alternative& other) {
    return other.score < found.best.score - kAlternativesMargin;
  });
  return MatchDoubt{match.utime, from_utime == 0 ? match.reference_utime : from_utime, *why,
                    std::move(others)};
}

std::optional<Reason> ChainDoubt::reason(const ScanMatch& match, const MotionEstimate& expected,
                                         const PoseSearchResult& found,
                                         const std::vector<Alternative>& others) const {
  const bool lost = match.status == ScanMatch::Status::kLost;
  const double score = found.best.score;
  if (lost && unlocated_m_ > params_.unlocated_max_m) return Reason::kLost;
  if (expected.from_odometry || (expected.from_gyro && !found.complete)) {
    const bool contradicted =
        !lost && score < params_.weak_score && found.best.sigmas > params_.contradicted_sigmas;
    return contradicted ? std::optional(Reason::kContradicted) : std::nullopt;
  }
  if (unobserved_m_ > params_.unobserved_max_m) return Reason::kDegenerate;
  if (!found.complete) return std::nullopt;
  if (lost) return Reason::kLost;
  const double margin = others.empty() ? 1.0 : score - others.front().score;
  if (score < params_.poor_score) return Reason::kPoor;
  if (score < params_.weak_score && margin < params_.weak_margin) return Reason::kPoor;
  if (margin < params_.margin) return Reason::kAmbiguous;
  return std::nullopt;
}

/// The poses other than the best that were rated, best first. In a short time the body cannot
/// change a known speed by so much that it is elsewhere.
std::vector<Alternative> ChainDoubt::distinct(const MotionEstimate& expected,
                                              const PoseSearchResult& found) const {
  const double reach_m = expected.speed_known ? params_.acceleration_max_m_s2 *
                                                    expected.unmeasured_s * expected.unmeasured_s
                                              : std::numeric_limits<double>::infinity();
  std::vector<PoseCandidate> sorted = found.reachable;
  std::stable_sort(
      sorted.begin(), sorted.end(),
      [](const PoseCandidate& a, const PoseCandidate& b) { return a.score > b.score; });
  const Pose2& best = found.best.match.T_odom_body;
  std::vector<Alternative> others;
  for (const PoseCandidate& candidate : sorted) {
    const Pose2& T = candidate.match.T_odom_body;
    const bool reachable = between(best, T).translation().norm() <= reach_m;
    const auto same = [&](const Pose2& other) {
      return is_near(other, T, params_.distinct_m, params_.distinct_rad);
    };
    const bool known = same(best) || std::ranges::any_of(others, [&](const Alternative& other) {
                         return same(other.T_odom_body);
                       });
    if (!reachable || known) continue;
    others.push_back({T, candidate.score});
    if (others.size() == kAlternativesMax) break;
  }
  return others;
}

/// Whether nothing measured a motion for much longer than between other scans: however good, one
/// match is no evidence that it is not another place that looks alike. A body that is where it was
/// stood.
bool ChainDoubt::is_gap(const ScanMatch& match, const MotionEstimate& expected) const {
  if (expected.from_odometry || interval_s_ == 0.0) return false;
  const auto moved_m = [&](const Pose2& T_odom_body) {
    return between(expected.T_odom_last, T_odom_body).translation().norm();
  };
  return expected.unmeasured_s > params_.gap_intervals * interval_s_ &&
         std::max(moved_m(match.T_odom_body), moved_m(expected.prior.T_odom_body)) >
             params_.gap_moved_max_m;
}

/// Of steps without wheels. One gap must not make the next ones usual.
void ChainDoubt::add_interval(const ScanMatch& match, const MotionEstimate& expected) {
  if (match.status == ScanMatch::Status::kLost || expected.unmeasured_s <= 0.0) return;
  if (interval_s_ == 0.0) interval_s_ = expected.unmeasured_s;
  const double bounded_s = std::min(expected.unmeasured_s, 2.0 * interval_s_);
  interval_s_ += kIntervalShare * (bounded_s - interval_s_);
}

void ChainDoubt::add_unlocated(const ScanMatch& match) {
  const bool lost = match.status == ScanMatch::Status::kLost;
  unlocated_m_ = lost ? unlocated_m_ + match.T_reference_body.translation().norm() : 0.0;
}

void ChainDoubt::add_unobserved(const ScanMatch& match) {
  if (match.status == ScanMatch::Status::kLost) return;
  if (!has_unobserved_direction(match)) {
    unobserved_m_ = 0.0;
    return;
  }
  if (unobserved_m_ == 0.0) unobserved_from_utime_ = match.reference_utime;
  unobserved_m_ += match.T_reference_body.translation().norm();
}

}  // namespace adit

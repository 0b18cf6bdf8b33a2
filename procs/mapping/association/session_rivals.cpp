// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "procs/mapping/association/session_rivals.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <iterator>
#include <limits>
#include <map>

namespace adit {
namespace {

constexpr double kSameM = 0.3;     // between alternatives for one place,
constexpr double kSameRad = 0.1;   // and of their headings
constexpr double kOutside = 0.02;  // probability of a place beyond any interval of 95 %
constexpr double kRefuted = 7.0;   // log-odds: one in a thousand
// Log-odds by a local map that was searched there, too (spread_to), and not found, where its match
// tells the two places apart.
constexpr double kNotThere = 1.5;
constexpr double kApart = 9.0;   // squared Mahalanobis distance of these
constexpr double kBeyond = 1.3;  // of a search, so that the peak is not at its rim

/// The shift of a session, seen from another of its maps.
Pose2 shift_at(const SessionRival& rival, const Hypothesis& hypothesis, int map) {
  const auto at = [&](int i) -> const Pose2& { return hypothesis.T_map_local[as_index(i)]; };
  const Pose2 T_first_map = between(at(rival.first), at(map));
  return T_first_map.inverse() * rival.shift * T_first_map;
}

bool is_same(const Pose2& a, const Pose2& b) {
  const Pose2 difference = between(a, b);
  return difference.translation().norm() < kSameM && std::abs(difference.theta) < kSameRad;
}

/// The shifts of a local map to the other places where a loop closure finds it, with the
/// log-likelihood of the chosen place over that of each.
struct Shift {
  Pose2 T_here_there;
  double log_odds = 0.0;
};
std::vector<Shift> shifts_of(const LoopClosure& loop_closure, int chosen) {
  const LoopClosureAlternative& here = loop_closure.alternatives[as_index(chosen)];
  std::vector<Shift> shifts;
  for (const LoopClosureAlternative& there : loop_closure.alternatives) {
    if (there.older_map != here.older_map) continue;
    const Pose2 T_here_there = between(here.T_older_newer, there.T_older_newer);
    if (is_same(T_here_there, {})) continue;
    shifts.push_back({T_here_there, here.log_likelihood - there.log_likelihood});
  }
  return shifts;
}

/// Accepted loop closures of one session with older ones, by their newer maps.
using Links = std::map<int, std::vector<int>>;

Links links_of(const AssociationProblem& problem, const Hypothesis& hypothesis, int first,
               int end) {
  Links links;
  for (std::size_t k = 0; k < hypothesis.chosen.size(); ++k) {
    const LoopClosure& loop_closure = problem.loop_closures[k];
    const int chosen = hypothesis.chosen[k];
    if (chosen < 0 || loop_closure.newer_map < first || loop_closure.newer_map >= end) continue;
    if (loop_closure.alternatives[as_index(chosen)].older_map < first)
      links[loop_closure.newer_map].push_back(static_cast<int>(k));
  }
  return links;
}

/// Mean log-odds of the loop closures of one map: of those that found it at the rival place, too;
/// if none did, of those that can tell the places apart.
double log_odds_by(const AssociationProblem& problem, const Hypothesis& hypothesis,
                   const std::vector<int>& loop_closures, const Pose2& shift) {
  double sum = 0.0;
  int found = 0;
  bool tells_apart = false;
  for (const int k : loop_closures) {
    const LoopClosure& loop_closure = problem.loop_closures[as_index(k)];
    const int chosen = hypothesis.chosen[as_index(k)];
    const Eigen::Vector3d off = shift.vector();
    const double apart = off.dot(loop_closure.alternatives[as_index(chosen)].information * off);
    tells_apart = tells_apart || apart > kApart;
    const auto shifts = shifts_of(loop_closure, chosen);
    const auto there = std::ranges::find_if(
        shifts, [&](const Shift& each) { return is_same(each.T_here_there, shift); });
    if (there == shifts.end()) continue;
    sum += there->log_odds;
    ++found;
  }
  if (found > 0) return sum / found;
  return tells_apart ? kNotThere : 0.0;
}

/// Log-odds by what is known of the motion between the end of the session before and local map
/// `first`, the first of this one.
double log_odds_by_link(const AssociationProblem& problem, const Hypothesis& hypothesis, int first,
                        const SessionRival& rival) {
  const PoseConstraint& link = problem.chain[as_index(first - 1)];
  const Pose2 T_last_first =
      between(hypothesis.T_map_local[as_index(first - 1)], hypothesis.T_map_local[as_index(first)]);
  const auto cost = [&](const Pose2& T_last_there) {
    const Eigen::Vector3d error = between(link.T_from_to, T_last_there).vector();
    return 0.5 * error.dot(link.information * error);
  };
  return cost(T_last_first * shift_at(rival, hypothesis, first)) - cost(T_last_first);
}

void add_rivals(const AssociationProblem& problem, const Hypothesis& hypothesis, int first, int end,
                std::vector<SessionRival>& rivals) {
  const Links links = links_of(problem, hypothesis, first, end);
  if (links.empty()) return;
  const auto& [map, loop_closures] = *links.begin();
  std::vector<SessionRival> found;
  for (const int k : loop_closures) {
    for (const Shift& shift :
         shifts_of(problem.loop_closures[as_index(k)], hypothesis.chosen[as_index(k)])) {
      const bool is_known = std::ranges::any_of(found, [&](const SessionRival& rival) {
        return is_same(rival.shift, shift.T_here_there);
      });
      if (!is_known) found.push_back({map, end, shift.T_here_there, 0.0});
    }
  }
  for (SessionRival& rival : found) {
    rival.log_odds = log_odds_by_link(problem, hypothesis, first, rival);
    for (const auto& [newer, of_newer] : links) {
      const Pose2 shift = shift_at(rival, hypothesis, newer);
      rival.log_odds += log_odds_by(problem, hypothesis, of_newer, shift);
    }
    if (rival.log_odds < kRefuted) rivals.push_back(rival);
  }
}

Eigen::Matrix3d square_of(const Pose2& shift) {
  const Eigen::Vector3d v = shift.vector();
  return v * v.transpose();
}

}  // namespace

double SessionRival::probability() const { return 1.0 / (1.0 + std::exp(log_odds)); }

std::vector<SessionRival> session_rivals(const AssociationProblem& problem,
                                         const Hypothesis& hypothesis,
                                         const std::vector<int>& first_maps) {
  std::vector<SessionRival> rivals;
  for (std::size_t s = 1; s < first_maps.size(); ++s) {
    const int end = s + 1 < first_maps.size() ? first_maps[s + 1] : std::numeric_limits<int>::max();
    add_rivals(problem, hypothesis, first_maps[s], end, rivals);
  }
  return rivals;
}

Eigen::Matrix3d moment_of(const SessionRival& rival, const Hypothesis& hypothesis, int map) {
  if (map < rival.first || rival.probability() < kOutside) return Eigen::Matrix3d::Zero();
  return rival.probability() * square_of(shift_at(rival, hypothesis, map));
}

Eigen::Matrix3d spread_to(const SessionRival& rival, const Hypothesis& hypothesis, int map,
                          double sigmas) {
  if (map < rival.first) return Eigen::Matrix3d::Zero();
  const double scale = kBeyond / sigmas;
  return scale * scale * square_of(shift_at(rival, hypothesis, map));
}

}  // namespace adit

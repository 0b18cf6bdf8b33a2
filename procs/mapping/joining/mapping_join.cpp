// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
//
// Mapping::join: a finished map of another run becomes sessions of this one.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <optional>
#include <set>
#include <utility>

#include <fmt/format.h>

#include "common/geometry/order_statistics.hpp"
#include "common/geometry/symmetric_eigen.hpp"
#include "procs/mapping/mapping.hpp"

namespace adit {
namespace {

// Standard deviation of a match in its least certain direction, beyond which it fixes nothing
// there.
constexpr double kFixedSdM = 0.1;
// Local maps of the run that are searched before it is checked whether they suffice, and the
// multiple of the necessary places that suffices.
constexpr int kSearchedAtOnce = 4;
constexpr int kPlacesEnough = 2;
constexpr double kOverlapToleranceM = 0.5;   // for the comparison of walls at the final poses
constexpr std::size_t kOwnComparisons = 50;  // local maps whose walls are compared within a map

std::size_t at(int i) { return static_cast<std::size_t>(i); }

/// The direction in the plane of which a match is least certain; nothing if it does not fix it.
std::optional<Eigen::Vector2d> least_certain_direction(const Eigen::Matrix3d& information) {
  if (information(2, 2) <= 0.0) return std::nullopt;
  const Eigen::Matrix2d plane =
      information.topLeftCorner<2, 2>() -
      information.topRightCorner<2, 1>() * information.bottomLeftCorner<1, 2>() / information(2, 2);
  const SymmetricEigen<2> eigen = symmetric_eigen(plane);
  if (eigen.values.x() < 1.0 / (kFixedSdM * kFixedSdM)) return std::nullopt;
  return eigen.vectors.col(0);
}

/// The middle of the walls that face a direction: those which fix a match along it.
Eigen::Vector2d middle_of_walls_facing(const LocalWalls& walls, const Eigen::Vector2d& direction) {
  Eigen::Vector2d sum = Eigen::Vector2d::Zero();
  double weights = 0.0;
  for (const SurfacePoint& point : walls.points) {
    const double facing = point.normal.dot(direction);
    sum += facing * facing * point.p;
    weights += facing * facing;
  }
  return weights > 0.0 ? Eigen::Vector2d(sum / weights) : Eigen::Vector2d(0.0, 0.0);
}

/// The candidates of a local map among those before `end` only, of which none is its neighbour in
/// time. `near`, `extents`: as of `loop_closure_candidates`.
std::vector<LoopClosureCandidate> candidates_before(int end, std::span<const Pose2> poses,
                                                    std::vector<NearMap> near,
                                                    std::span<const MapExtent> extents,
                                                    LoopClosureCandidatesParams params) {
  std::erase_if(near, [end](const NearMap& n) { return n.older >= end; });
  params.neighbours = static_cast<int>(poses.size()) - 1 - end;
  return loop_closure_candidates(poses, near, extents.first(poses.size()), params);
}

/// Local maps that are at least `apart_m` from each other, each next one far from those before, so
/// that the first few are all over the map.
std::vector<int> spread(const std::vector<Pose2>& poses, const LocalMapStore& maps,
                        double apart_m) {
  std::vector<int> chosen;
  std::vector<double> distance_m(poses.size(), 1e9);
  while (true) {
    int farthest = -1;
    for (std::size_t i = 0; i < poses.size(); ++i) {
      const bool usable = !maps[i].scans.empty() && distance_m[i] >= apart_m;
      if (usable && (farthest < 0 || distance_m[i] > distance_m[at(farthest)]))
        farthest = static_cast<int>(i);
    }
    if (farthest < 0) return chosen;
    chosen.push_back(farthest);
    for (std::size_t i = 0; i < poses.size(); ++i) {
      distance_m[i] = std::min(distance_m[i],
                               (poses[i].translation() - poses[at(farthest)].translation()).norm());
    }
  }
}

/// Third quartile of the absolute deviations from the median; 0 without values.
double deviation(std::vector<double> values) {
  const double median = quantile(values, 0.5);
  for (double& value : values) value = std::abs(value - median);
  return quantile(std::move(values), 0.75);
}

/// Of the alignments that were tried: the first where the run can be joined, if the walls agree at
/// no other one; otherwise the best, which then is not joined.
std::size_t choose(std::vector<RunJoin>& tried) {
  const auto joined = std::ranges::find_if(tried, &RunJoin::joined);
  if (joined == tried.end()) return 0;
  const auto other = std::ranges::find_if(
      tried, [&](const RunJoin& join) { return join.walls_agree && &join != &*joined; });
  if (other != tried.end()) {
    joined->joined = false;
    joined->reason = fmt::format("the run fits at two places, by {} places and by {}",
                                 joined->places, other->places);
  }
  return static_cast<std::size_t>(joined - tried.begin());
}

/// A possible pose of a map of the run on a map of this one, from the reverse.
LoopClosureAlternative reversed(const LoopClosureAlternative& a, int older) {
  const Pose2 T_older_newer = a.T_older_newer.inverse();
  const Eigen::Matrix3d J = adjoint(T_older_newer);
  LoopClosureAlternative reverse = a;
  reverse.older_map = older;
  reverse.T_older_newer = T_older_newer;
  reverse.information = J.transpose() * a.information * J;
  return reverse;
}

std::string too_few_text(int places, int needed) {
  return fmt::format("the links agree at {} place{}, {} are needed", places, places == 1 ? "" : "s",
                     needed);
}

}  // namespace

RunJoin Mapping::join(const Mapping& run, const RunJoinParams& params) {
  RunJoin join;
  const auto first = static_cast<int>(maps_.size());
  join.first_map = first;
  if (maps_.empty() || run.maps_.empty()) {
    join.reason = "no local map";
    return join;
  }
  const std::vector<PossibleJoin> possible = find_run(run, params, join);
  if (possible.empty()) return join;
  join.own_apart_m = std::max(own_walls_apart_m(), run.own_walls_apart_m());
  const LazyAssociation::Checkpoint before = association_.checkpoint();
  const std::size_t lost_before = lost_.size();
  const auto remove_run = [&] {
    association_.roll_back(before);
    while (static_cast<int>(maps_.size()) > first) remove_newest_map();
    lost_.resize(lost_before);
    update_heights();
  };
  std::vector<RunJoin> tried;
  for (const PossibleJoin& there : possible) {
    if (!tried.empty()) remove_run();
    tried.push_back(place_run(run, there, params, join));
  }
  const std::size_t chosen = choose(tried);
  if (chosen + 1 < tried.size() && tried[chosen].joined) {
    remove_run();
    tried[chosen] = place_run(run, possible[chosen], params, join);
  }
  join = std::move(tried[chosen]);
  if (!join.joined) {
    remove_run();
    return join;
  }
  builder_ =
      LocalMapBuilder(params_.local_maps, mounts_, maps_.back().id + 1, maps_.back().session + 1);
  odom_ = Odom::kRestored;
  odom_continues_ = false;
  end_is_lost_ = end_is_lost_ || run.end_is_lost_;
  ++revision_;
  covariance_ = covariance_in_older_sessions();
  update_covariance_from_first();
  update_contradictions();
  return join;
}

/// Places the run at one of the alignments, as if it lay there.
RunJoin Mapping::place_run(const Mapping& run, const PossibleJoin& possible,
                           const RunJoinParams& params, RunJoin join) {
  join.agreeing = static_cast<int>(possible.alignment.agreeing.size());
  join.places = possible.alignment.places;
  join.T_map_run = possible.alignment.T_map_run;
  append_run(run, join);
  link_run(possible.agreeing, join.first_map);
  compare_walls_of_run(join.first_map, join);
  judge_run(params, join);
  return join;
}

/// Relocalises local maps of the run in this map, anywhere, until enough places agree; if they do
/// not, those of this map in the run: a map alone is searched in several together. Returns where it
/// may lie, best first; nothing if the run cannot be joined, and the reason in `join`.
std::vector<PossibleJoin> Mapping::find_run(const Mapping& run, const RunJoinParams& params,
                                            RunJoin& join) const {
  const std::vector<Pose2>& map_poses = association_.hypothesis().T_map_local;
  const std::vector<Pose2>& run_poses = run.association_.hypothesis().T_map_local;
  const std::vector<int> older_maps = spread(map_poses, maps_, params.apart_m);
  const std::vector<int> newer_maps = spread(run_poses, run.maps_, params.apart_m);
  std::vector<RunLink> links;
  std::vector<LoopClosure> found;
  const auto add = [&](int older, int newer, LoopClosureAlternative a) {
    const auto direction = least_certain_direction(a.information);
    if (!direction) return;
    links.push_back({older, newer, a.T_older_newer, a.log_likelihood,
                     middle_of_walls_facing(*run.walls_[at(newer)], *direction)});
    found.push_back({0, newer, {std::move(a)}});
  };
  const auto align = [&] { return align_run(links, map_poses, run_poses, params.alignment); };
  const auto places_of = [](const std::vector<RunAlignment>& alignments) {
    return alignments.empty() ? 0 : alignments.front().places;
  };
  int searched = 0;
  for (const int newer : newer_maps) {
    for (const int older : older_maps) {
      ++join.searched;
      for (LoopClosureAlternative& a : found_anywhere(*run.walls_[at(newer)], older, map_poses))
        add(older, newer, std::move(a));
    }
    if (++searched % kSearchedAtOnce == 0 &&
        places_of(align()) >= kPlacesEnough * params.alignment.places_min)
      break;
  }
  std::vector<RunAlignment> alignments = align();
  if (places_of(alignments) < params.alignment.places_min) {
    for (const int older : older_maps) {
      for (const int newer : newer_maps) {
        ++join.searched;
        for (const LoopClosureAlternative& a :
             run.found_anywhere(*walls_[at(older)], newer, run_poses))
          add(older, newer, reversed(a, older));
      }
    }
    alignments = align();
  }
  join.found = static_cast<int>(links.size());
  join.places = places_of(alignments);
  join.rivals = std::max(0, static_cast<int>(alignments.size()) - 1);
  if (join.places < params.alignment.places_min) {
    join.reason = too_few_text(join.places, params.alignment.places_min);
    return {};
  }
  std::vector<PossibleJoin> possible;
  for (const RunAlignment& alignment : alignments) {
    PossibleJoin& there = possible.emplace_back(PossibleJoin{alignment, {}});
    std::set<std::array<int, 2>> pairs;  // of which the most likely pose comes first
    for (const std::size_t k : alignment.agreeing) {
      if (pairs.insert({links[k].older, links[k].newer}).second) there.agreeing.push_back(found[k]);
    }
    std::ranges::stable_sort(there.agreeing, {}, &LoopClosure::newer_map);
  }
  return possible;
}

/// Appends the local maps of the run, its own walls and decisions, as sessions that begin at an
/// unknown place; near the alignment, where the graph is linearised.
void Mapping::append_run(const Mapping& run, RunJoin& join) {
  const int first = join.first_map;
  const int first_loop_closure = static_cast<int>(association_.problem().loop_closures.size());
  const std::vector<Pose2>& run_poses = run.association_.hypothesis().T_map_local;
  join.session = maps_.back().session + 1;
  for (std::size_t i = 0; i < run.maps_.size(); ++i) {
    LocalMap map = run.maps_.load(i);
    if (i == 0) {
      map.T_previous_local =
          between(association_.hypothesis().T_map_local.back(), join.T_map_run * run_poses.front());
      map.information = information_of_unknown_pose();
      map.climb_m = map.forward_m = 0.0;
    }
    map.id = first + static_cast<int>(i);
    map.session += join.session - run.maps_.front().session;
    walls_.push_back(*run.walls_[i]);
    extents_.push_back(run.extents_[i]);
    reach_m_.push_back(run.reach_m_[i]);
    association_.add_map(map.T_previous_local, map.information);
    maps_.push_back(std::move(map));
  }
  for (const int lost : run.lost_) lost_.push_back(first + lost);
  std::vector<Association> decided;
  for (std::size_t k = 0; k < run.association_.problem().loop_closures.size(); ++k) {
    Association a;
    a.utime = maps_.back().end_utime;
    a.loop_closure = run.association_.problem().loop_closures[k];
    a.loop_closure.id = first_loop_closure + static_cast<int>(k);
    a.loop_closure.newer_map += first;
    for (LoopClosureAlternative& alternative : a.loop_closure.alternatives)
      alternative.older_map += first;
    a.chosen = run.association_.hypothesis().chosen[k];
    decided.push_back(std::move(a));
  }
  association_.restore(decided);
  std::vector<CloudMatch> matches;
  for (int map = 0; map < static_cast<int>(run.maps_.size()); ++map) {
    for (CloudMatch match : run.cloud_matches(map)) {
      match.older.map += first;
      match.newer.map += first;
      matches.push_back(match);
    }
  }
  add_matches(matches);
  heights_.add_new(maps_.headers());
  update_heights();
}

/// Decides the loop closures that agree, then those of each local map of the run where it lies now.
void Mapping::link_run(std::vector<LoopClosure> agreeing, int first) {
  const std::int64_t utime = maps_.back().end_utime;
  std::set<std::array<int, 2>> proposed;
  for (LoopClosure& loop_closure : agreeing) {
    loop_closure.newer_map += first;
    proposed.insert({loop_closure.alternatives.front().older_map, loop_closure.newer_map});
  }
  association_.decide(std::move(agreeing), utime);
  update_heights();
  for (int map = first; map < static_cast<int>(maps_.size()); ++map) {
    if (maps_[at(map)].scans.empty()) continue;
    Trial& trial = association_.trial();
    std::vector<Pose2> poses = trial.poses();
    poses.resize(at(map) + 1);
    std::vector<LoopClosureCandidate> candidates =
        candidates_before(first, poses, trial.near_maps(map, reach_m_, params_.candidates.sigmas),
                          extents_, params_.candidates);
    std::erase_if(candidates, [&](const LoopClosureCandidate& candidate) {
      return proposed.contains({candidate.older, map});
    });
    association_.decide(matches_of(candidates, map, poses), utime);
  }
  update_heights();
  association_.reconsider(utime);
  update_heights();
}

/// The local maps before `end` that a map overlaps where it lies now, on its level.
std::vector<LoopClosureCandidate> Mapping::overlapped(int map, int end) const {
  if (maps_[at(map)].scans.empty()) return {};
  const std::span<const Pose2> until =
      std::span(association_.hypothesis().T_map_local).first(at(map) + 1);
  std::vector<LoopClosureCandidate> found = candidates_before(
      end, until, within_reach(until, kOverlapToleranceM, Eigen::Matrix3d::Zero()), extents_,
      params_.candidates);
  std::erase_if(found, [&](const LoopClosureCandidate& candidate) {
    return !heights_.same_level(candidate.older, map, candidate.predicted.T_older_newer, walls_);
  });
  return found;
}

/// Compares the walls of the run, at the poses of the joined map, with those of the other runs that
/// they overlap.
void Mapping::compare_walls_of_run(int first, RunJoin& join) const {
  std::vector<double> before_m;
  const std::vector<Pose2>& poses = association_.hypothesis().T_map_local;
  for (int map = first; map < static_cast<int>(maps_.size()); ++map) {
    for (const LoopClosureCandidate& candidate : overlapped(map, first)) {
      const WallComparison compared =
          compare_walls(*walls_[at(map)], walls_around(candidate.older, poses),
                        candidate.predicted.T_older_newer, params_.matching);
      join.observed_m += compared.observed_m;
      join.contradicting_m += compared.contradicting_m;
      before_m.insert(before_m.end(), compared.before_m.begin(), compared.before_m.end());
    }
  }
  join.walls_apart_m = deviation(std::move(before_m));
}

/// Distance between walls of this map where its local maps overlap.
double Mapping::own_walls_apart_m() const {
  std::vector<double> before_m;
  const std::size_t step = std::max<std::size_t>(1, maps_.size() / kOwnComparisons);
  for (std::size_t i = 0; i < maps_.size(); i += step) {
    const int map = static_cast<int>(i);
    for (const LoopClosureCandidate& candidate : overlapped(map, map)) {
      std::vector<PlacedWalls> older(1);
      older.front().walls = walls_[at(candidate.older)];
      const WallComparison compared =
          compare_walls(*walls_[i], older, candidate.predicted.T_older_newer, params_.matching);
      before_m.insert(before_m.end(), compared.before_m.begin(), compared.before_m.end());
    }
  }
  return deviation(std::move(before_m));
}

/// Counts the links in force, and decides whether the run stays.
void Mapping::judge_run(const RunJoinParams& params, RunJoin& join) const {
  const std::vector<LoopClosure>& loop_closures = association_.problem().loop_closures;
  const Hypothesis& hypothesis = association_.hypothesis();
  std::vector<Eigen::Vector2d> evidence;
  for (std::size_t k = 0; k < loop_closures.size(); ++k) {
    const LoopClosure& loop_closure = loop_closures[k];
    if (loop_closure.newer_map < join.first_map ||
        loop_closure.alternatives.front().older_map >= join.first_map)
      continue;
    if (hypothesis.chosen[k] == Association::kNone) {
      ++join.rejected;
      continue;
    }
    const LoopClosureAlternative& a = loop_closure.alternatives[at(hypothesis.chosen[k])];
    join.links.push_back(
        {a.older_map, loop_closure.newer_map, a.T_older_newer, a.log_likelihood, a.information});
    const auto direction = least_certain_direction(a.information);
    if (!direction || a.log_likelihood < kRelocalisedLogLikelihood) continue;
    evidence.push_back(hypothesis.T_map_local[at(loop_closure.newer_map)] *
                       middle_of_walls_facing(*walls_[at(loop_closure.newer_map)], *direction));
  }
  join.places = distinct_places(evidence, params.alignment.place_m);
  const double apart_max_m =
      params.walls_apart_ratio * join.own_apart_m + params.walls_apart_added_m;
  join.walls_agree =
      join.contradicting_share() <= params.contradicting_max && join.walls_apart_m <= apart_max_m;
  if (join.places < params.alignment.places_min) {
    join.reason = too_few_text(join.places, params.alignment.places_min);
  } else if (join.contradicting_share() > params.contradicting_max) {
    join.reason =
        fmt::format("{:.0f} % of the walls that both observed lie in free space of the other",
                    100.0 * join.contradicting_share());
  } else if (!join.walls_agree) {
    join.reason = fmt::format(
        "walls that both observed are {:.0f} mm apart, by what each run shows of its own {:.0f} "
        "are allowed",
        1e3 * join.walls_apart_m, 1e3 * apart_max_m);
  } else {
    join.joined = true;
    join.reason = fmt::format("{} links at {} places agree", join.links.size(), join.places);
  }
}

}  // namespace adit

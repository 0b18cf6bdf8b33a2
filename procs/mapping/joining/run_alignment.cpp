// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "procs/mapping/joining/run_alignment.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace adit {
namespace {

constexpr double kElsewhereM = 2.0;
constexpr double kElsewhereRad = 0.3;
constexpr std::size_t kAlignmentsMax = 8;

/// The links with the poses of both maps.
class Alignment {
 public:
  Alignment(const std::vector<RunLink>& links, const std::vector<Pose2>& map_poses,
            const std::vector<Pose2>& run_poses, const RunAlignmentParams& params)
      : links_(links), map_poses_(map_poses), run_poses_(run_poses), params_(params) {
    for (const RunLink& link : links) {
      T_map_run_.push_back(map_pose(link) * link.T_older_newer * run_pose(link).inverse());
    }
  }

  /// The best set of links among these, which all are supporters but only some may lead.
  [[nodiscard]] RunAlignment best(const std::vector<std::size_t>& leaders) const {
    RunAlignment best;
    double best_likelihood = 0.0;
    for (const std::size_t leader : leaders) {
      const std::vector<std::size_t> agreeing = agreeing_with(leader);
      const int places = places_of(agreeing, T_map_run_[leader]);
      const double likelihood = std::accumulate(
          agreeing.begin(), agreeing.end(), 0.0,
          [&](double sum, std::size_t k) { return sum + links_[k].log_likelihood; });
      if (places < best.places || (places == best.places && likelihood <= best_likelihood))
        continue;
      best = {T_map_run_[leader], agreeing, places};
      best_likelihood = likelihood;
    }
    return best;
  }

  /// Those of the links that put the run elsewhere than this alignment, where they are.
  [[nodiscard]] std::vector<std::size_t> elsewhere(const std::vector<std::size_t>& links,
                                                   const RunAlignment& alignment) const {
    std::vector<std::size_t> found;
    for (const std::size_t k : links) {
      const Pose2& at = run_pose(links_[k]);
      const Pose2 apart = between(alignment.T_map_run * at, T_map_run_[k] * at);
      const double drift_m = params_.position_per_m * at.translation().norm();
      if (apart.translation().norm() > kElsewhereM + drift_m ||
          std::abs(apart.theta) > kElsewhereRad)
        found.push_back(k);
    }
    return found;
  }

 private:
  [[nodiscard]] const Pose2& map_pose(const RunLink& link) const {
    return map_poses_[static_cast<std::size_t>(link.older)];
  }
  [[nodiscard]] const Pose2& run_pose(const RunLink& link) const {
    return run_poses_[static_cast<std::size_t>(link.newer)];
  }

  [[nodiscard]] std::vector<std::size_t> agreeing_with(std::size_t leader) const {
    std::vector<std::size_t> agreeing;
    for (std::size_t k = 0; k < links_.size(); ++k) {
      if (agree(leader, k)) agreeing.push_back(k);
    }
    return agreeing;
  }

  [[nodiscard]] bool agree(std::size_t leader, std::size_t k) const {
    const Pose2& at = run_pose(links_[k]);
    const double apart_m = (at.translation() - run_pose(links_[leader]).translation()).norm();
    const Pose2 off = between(T_map_run_[leader] * at, T_map_run_[k] * at);
    return off.translation().norm() <= params_.position_m + params_.position_per_m * apart_m &&
           std::abs(off.theta) <= params_.angle_rad + params_.angle_per_m * apart_m;
  }

  [[nodiscard]] int places_of(const std::vector<std::size_t>& links, const Pose2& T_map_run) const {
    std::vector<Eigen::Vector2d> points;
    for (const std::size_t k : links) {
      points.push_back(T_map_run * run_pose(links_[k]) * links_[k].p_newer_evidence);
    }
    return distinct_places(points, params_.place_m);
  }

  const std::vector<RunLink>& links_;
  const std::vector<Pose2>& map_poses_;
  const std::vector<Pose2>& run_poses_;
  const RunAlignmentParams& params_;
  std::vector<Pose2> T_map_run_;  ///< by each link alone
};

}  // namespace

int distinct_places(const std::vector<Eigen::Vector2d>& points, double place_m) {
  std::vector<Eigen::Vector2d> places;
  for (const Eigen::Vector2d& p : points) {
    const bool is_new = std::ranges::none_of(
        places, [&](const Eigen::Vector2d& other) { return (p - other).norm() < place_m; });
    if (is_new) places.push_back(p);
  }
  return static_cast<int>(places.size());
}

std::vector<RunAlignment> align_run(const std::vector<RunLink>& links,
                                    const std::vector<Pose2>& map_poses,
                                    const std::vector<Pose2>& run_poses,
                                    const RunAlignmentParams& params) {
  const Alignment alignment(links, map_poses, run_poses, params);
  std::vector<std::size_t> leaders(links.size());
  std::iota(leaders.begin(), leaders.end(), std::size_t{0});
  std::vector<RunAlignment> found;
  while (found.size() < kAlignmentsMax) {
    RunAlignment next = alignment.best(leaders);
    const int places_min = found.empty() ? 0 : found.front().places;
    if (next.places == 0 || next.places <= params.rival_share * places_min) break;
    leaders = alignment.elsewhere(leaders, next);
    found.push_back(std::move(next));
  }
  return found;
}

}  // namespace adit

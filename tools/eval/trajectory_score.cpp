// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "tools/eval/trajectory_score.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <vector>

#include "common/geometry/angle.hpp"
#include "tools/eval/path_error.hpp"

namespace adit {
namespace {

constexpr double kStep = 0.5;  // of the way, for its length [m]

/// The truth with the trajectory at its times.
struct Station {
  double way_m = 0.0;  // along the truth
  Pose2 T_world_body;
  Pose2 T_map_body;
};

/// At the times of the truth that the trajectory covers.
std::vector<Station> stations_of(const Trajectory& trajectory, const Trajectory& truth) {
  std::vector<Station> stations;
  for (const auto& [utime, T_world_body] : truth) {
    const auto T_map_body = interpolate(trajectory, utime);
    if (!T_map_body) continue;
    double way = 0.0;
    if (!stations.empty()) {
      const Station& last = stations.back();
      way = last.way_m + between(last.T_world_body, T_world_body).translation().norm();
    }
    stations.push_back({way, T_world_body, *T_map_body});
  }
  return stations;
}

PositionErrors position_errors(const Trajectory& trajectory, const Trajectory& truth,
                               const Pose2& T_world_map) {
  PositionErrors errors;
  double squares = 0.0;
  double count = 0.0;
  for (const auto& [utime, T_map_body] : trajectory) {
    const auto T_world_body = interpolate(truth, utime);
    if (!T_world_body) continue;
    const double distance =
        (T_world_map * T_map_body.translation() - T_world_body->translation()).norm();
    squares += distance * distance;
    errors.mean_m += distance;
    errors.max_m = std::max(errors.max_m, distance);
    count += 1.0;
  }
  errors.rmse_m = std::sqrt(squares / count);
  errors.mean_m /= count;
  return errors;
}

std::vector<Station>::const_iterator at_way(const std::vector<Station>& stations, double way_m) {
  return std::lower_bound(stations.begin(), stations.end(), way_m,
                          [](const Station& a, double way) { return a.way_m < way; });
}

/// Stretches begin each tenth of their length, as in the KITTI benchmark.
RelativeErrors relative_errors(const std::vector<Station>& stations, double length_m) {
  RelativeErrors errors{length_m};
  if (stations.empty()) return errors;
  for (int i = 0; i * length_m / 10.0 + length_m <= stations.back().way_m; ++i) {
    const Station& a = *at_way(stations, i * length_m / 10.0);
    const auto end = at_way(stations, a.way_m + length_m);
    if (end == stations.end()) break;
    const Pose2 error =
        between(between(a.T_world_body, end->T_world_body), between(a.T_map_body, end->T_map_body));
    errors.translation_m += error.translation().norm();
    errors.rotation_deg += rad_to_deg(std::abs(error.theta));
    ++errors.stretches;
  }
  if (errors.stretches == 0) return errors;
  errors.translation_m /= static_cast<double>(errors.stretches);
  errors.rotation_deg /= static_cast<double>(errors.stretches);
  return errors;
}

double length_ratio(const std::vector<Station>& stations) {
  double found = 0.0;
  double true_length = 0.0;
  for (auto from = stations.begin(); from != stations.end();) {
    const auto to = at_way(stations, from->way_m + kStep);
    if (to == stations.end()) break;
    found += between(from->T_map_body, to->T_map_body).translation().norm();
    true_length += between(from->T_world_body, to->T_world_body).translation().norm();
    from = to;
  }
  return true_length > 0.0 ? found / true_length : 0.0;
}

Pose2 anchor(const Trajectory& trajectory, const Trajectory& truth) {
  for (const auto& [utime, T_map_body] : trajectory) {
    if (const auto T_world_body = interpolate(truth, utime)) {
      return *T_world_body * T_map_body.inverse();
    }
  }
  throw std::runtime_error("the trajectory and the truth have no time in common");
}

}  // namespace

TrajectoryScore score_trajectory(const Trajectory& trajectory, const Trajectory& truth) {
  TrajectoryScore score;
  score.anchored = position_errors(trajectory, truth, anchor(trajectory, truth));
  score.T_world_map = *align(trajectory, truth);
  score.aligned = position_errors(trajectory, truth, score.T_world_map);
  score.poses = static_cast<std::size_t>(
      std::count_if(trajectory.begin(), trajectory.end(),
                    [&](const TimedPose& at) { return interpolate(truth, at.utime).has_value(); }));
  const std::vector<Station> stations = stations_of(trajectory, truth);
  for (RelativeErrors& errors : score.relative) {
    errors = relative_errors(stations, errors.length_m);
  }
  if (!stations.empty()) score.true_length_m = stations.back().way_m;
  score.length_ratio = length_ratio(stations);
  return score;
}

Trajectory thinned(const Trajectory& trajectory, double step_m) {
  Trajectory kept;
  double way = 0.0;
  for (std::size_t i = 0; i < trajectory.size(); ++i) {
    if (i > 0) way += between(trajectory[i - 1].pose, trajectory[i].pose).translation().norm();
    if (i > 0 && way < step_m) continue;
    kept.push_back(trajectory[i]);
    way = 0.0;
  }
  return kept;
}

}  // namespace adit

// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "tools/eval/trajectory_score.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <vector>

#include "common/bus/channels.hpp"
#include "common/bus/log/event_source.hpp"
#include "common/geometry/pose2.hpp"
#include "common/messages/codec.hpp"
#include "common/messages/mapping/odometry.hpp"
#include "tools/eval/path_error.hpp"

namespace adit {
Trajectory read_ground_truth(const std::filesystem::path& log) {
  LogFile events(log);
  Trajectory trajectory;
  while (const auto event = events.next()) {
    if (event->channel != channels::kTruth) continue;
    const auto message = decode<pose_t>(event->data);
    if (!message) continue;
    const auto pose = from_message(*message);
    if (!pose || (!trajectory.empty() && pose->utime <= trajectory.back().utime)) continue;
    trajectory.push_back({pose->utime, pose->T_odom_body});
  }
  if (trajectory.empty()) throw std::runtime_error(log.string() + " holds no truth");
  return trajectory;
}

namespace {

constexpr double kStep = 0.5;  // of the way, for its length [m]

/// The truth with the trajectory at its times.
struct Station {
  double distance_m = 0.0;  // along the truth
  Pose2 T_world_body;
  Pose2 T_map_body;
};

/// At the times of the truth that the trajectory covers.
std::vector<Station> stations_of(const Trajectory& trajectory, const Trajectory& truth) {
  std::vector<Station> stations;
  for (const auto& [utime, T_world_body] : truth) {
    const auto T_map_body = interpolate(trajectory, utime);
    if (!T_map_body) continue;
    double distance = 0.0;
    if (!stations.empty()) {
      const Station& last = stations.back();
      distance = last.distance_m + between(last.T_world_body, T_world_body).translation().norm();
    }
    stations.push_back({distance, T_world_body, *T_map_body});
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

std::vector<Station>::const_iterator at_distance(const std::vector<Station>& stations,
                                                 double distance_m) {
  return std::lower_bound(
      stations.begin(), stations.end(), distance_m,
      [](const Station& a, double distance) { return a.distance_m < distance; });
}

/// Stretches begin each tenth of their length, as in the KITTI benchmark.
RelativeErrors relative_errors(const std::vector<Station>& stations, double length_m) {
  RelativeErrors errors{length_m};
  if (stations.empty()) return errors;
  for (int i = 0; i * length_m / 10.0 + length_m <= stations.back().distance_m; ++i) {
    const Station& a = *at_distance(stations, i * length_m / 10.0);
    const auto end = at_distance(stations, a.distance_m + length_m);
    if (end == stations.end()) break;
    const Pose2 error =
        between(between(a.T_world_body, end->T_world_body), between(a.T_map_body, end->T_map_body));
    errors.translation_m += error.translation().norm();
    errors.rotation_deg += rad_to_deg(std::abs(error.theta));
    ++errors.segments;
  }
  if (errors.segments == 0) return errors;
  errors.translation_m /= static_cast<double>(errors.segments);
  errors.rotation_deg /= static_cast<double>(errors.segments);
  return errors;
}

double length_ratio(const std::vector<Station>& stations) {
  double found = 0.0;
  double true_length = 0.0;
  for (auto from = stations.begin(); from != stations.end();) {
    const auto to = at_distance(stations, from->distance_m + kStep);
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
  if (!stations.empty()) score.true_length_m = stations.back().distance_m;
  score.length_ratio = length_ratio(stations);
  return score;
}

Trajectory downsampled(const Trajectory& trajectory, double step_m) {
  Trajectory kept;
  double distance = 0.0;
  for (std::size_t i = 0; i < trajectory.size(); ++i) {
    if (i > 0) distance += between(trajectory[i - 1].pose, trajectory[i].pose).translation().norm();
    if (i > 0 && distance < step_m) continue;
    kept.push_back(trajectory[i]);
    distance = 0.0;
  }
  return kept;
}

}  // namespace adit

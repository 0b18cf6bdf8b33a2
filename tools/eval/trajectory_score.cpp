// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "tools/eval/trajectory_score.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <stdexcept>
#include <vector>

#include <fmt/format.h>

#include "common/bus/channels.hpp"
#include "common/bus/log/event_source.hpp"
#include "common/geometry/pose2.hpp"
#include "common/messages/codec.hpp"
#include "common/messages/mapping/odometry.hpp"

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
    trajectory.push_back({pose->utime, pose->T_odom_body, pose->z_m});
  }
  if (trajectory.empty()) throw std::runtime_error(fmt::format("{} has no TRUTH", log.string()));
  return trajectory;
}

namespace {

constexpr double kLengthStepM = 0.5;  // for length_ratio

/// A pose of the truth with the pose of the trajectory at its time.
struct Station {
  double distance_m = 0.0;  // along the truth
  Pose2 T_world_body;
  Pose2 T_map_body;
};

/// Stations at the times of the truth that the trajectory covers.
std::vector<Station> stations_of(const Trajectory& trajectory, const Trajectory& truth) {
  std::vector<Station> stations;
  for (const auto& [utime, T_world_body, z_m] : truth) {
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

std::vector<Station>::const_iterator at_distance(const std::vector<Station>& stations,
                                                 double distance_m) {
  return std::lower_bound(
      stations.begin(), stations.end(), distance_m,
      [](const Station& a, double distance) { return a.distance_m < distance; });
}

/// Segments start every tenth of their length, as in the KITTI benchmark.
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
  double length = 0.0;
  double true_length = 0.0;
  for (auto from = stations.begin(); from != stations.end();) {
    const auto to = at_distance(stations, from->distance_m + kLengthStepM);
    if (to == stations.end()) break;
    length += between(from->T_map_body, to->T_map_body).translation().norm();
    true_length += between(from->T_world_body, to->T_world_body).translation().norm();
    from = to;
  }
  return true_length > 0.0 ? length / true_length : 0.0;
}

/// Root mean square of errors divided by the allowed ones, with the first poses aligned.
void add_of_allowed(const std::vector<PosePair>& pairs, const Pose2& T_world_map, double rise_m,
                    TrajectoryScore& score) {
  const PosePair& start = pairs.front();
  for (const PosePair& pair : pairs) {
    const Pose2 from_start = between(start.reference, pair.reference);
    const AllowedErrors allowed = allowed_errors(
        std::hypot(from_start.x, from_start.y, pair.z_reference_m - start.z_reference_m));
    const Eigen::Vector2d error =
        T_world_map * pair.estimate.translation() - pair.reference.translation();
    const double error_z_m = pair.z_estimate_m + rise_m - pair.z_reference_m;
    score.plan_of_allowed += error.squaredNorm() / (allowed.plan_m * allowed.plan_m);
    score.height_of_allowed += error_z_m * error_z_m / (allowed.height_m * allowed.height_m);
  }
  const auto count = static_cast<double>(pairs.size());
  score.plan_of_allowed = std::sqrt(score.plan_of_allowed / count);
  score.height_of_allowed = std::sqrt(score.height_of_allowed / count);
}

}  // namespace

AllowedErrors allowed_errors(double distance_from_start_m) {
  return {AllowedErrors::kAtStartM + AllowedErrors::kPlanShare * distance_from_start_m,
          AllowedErrors::kAtStartM + AllowedErrors::kHeightShare * distance_from_start_m};
}

TrajectoryScore score_trajectory(const Trajectory& trajectory, const Trajectory& truth) {
  const std::vector<PosePair> pairs = pose_pairs(trajectory, truth);
  if (pairs.empty()) {
    throw std::runtime_error("the trajectory and the truth have no time in common");
  }
  TrajectoryScore score;
  score.poses = pairs.size();
  const Pose2 T_world_map_anchored = pairs.front().reference * pairs.front().estimate.inverse();
  const double rise_anchored_m = pairs.front().z_reference_m - pairs.front().z_estimate_m;
  score.heights = has_heights(trajectory);
  score.anchored = position_errors(pairs, T_world_map_anchored, rise_anchored_m);
  add_of_allowed(pairs, T_world_map_anchored, rise_anchored_m, score);
  score.T_world_map = align(pairs);
  score.aligned = position_errors(pairs, score.T_world_map, mean_rise_m(pairs));
  const std::vector<Station> stations = stations_of(trajectory, truth);
  for (RelativeErrors& errors : score.relative) {
    errors = relative_errors(stations, errors.length_m);
  }
  if (!stations.empty()) score.true_length_m = stations.back().distance_m;
  score.length_ratio = length_ratio(stations);
  return score;
}

Trajectory downsampled(const Trajectory& trajectory, double step_m) {
  Trajectory selected;
  double distance = 0.0;
  for (std::size_t i = 0; i < trajectory.size(); ++i) {
    if (i > 0) distance += between(trajectory[i - 1].pose, trajectory[i].pose).translation().norm();
    if (i > 0 && distance < step_m) continue;
    selected.push_back(trajectory[i]);
    distance = 0.0;
  }
  return selected;
}

}  // namespace adit

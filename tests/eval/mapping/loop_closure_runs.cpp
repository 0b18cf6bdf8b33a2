// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "tests/eval/mapping/loop_closure_runs.hpp"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <limits>

#include <Eigen/LU>

#include "common/geometry/order_statistics.hpp"
#include "procs/scan_matching/scan_matching.hpp"
#include "tools/carmen/carmen_reader.hpp"
#include "tools/sim/sample_run.hpp"

namespace adit {
namespace {

constexpr const char* kChannel = "LASER_FRONT";

/// Scan matching and the builder of local maps.
class Mapper {
 public:
  void add(const WheelOdometry& reading) { matching_.add(reading); }

  void add(const LaserScan& scan) {
    const ScanMatch match = matching_.add_scan(LaserId::kFront, scan);
    if (match.status == ScanMatch::Status::kRejected) return;
    run_.matches.push_back(match);
    run_.odom.push_back({match.utime, match.T_odom_body});
    if (auto map = builder_.add(kChannel, scan, match)) run_.maps.push_back(std::move(*map));
  }

  MappedRun finish() {
    if (auto map = builder_.finish()) run_.maps.push_back(std::move(*map));
    const LaserMounts mounts{{kChannel, LaserMount{}}};
    for (const auto& map : run_.maps) {
      run_.walls.push_back(std::make_shared<const LocalWalls>(local_walls(map, mounts, {})));
    }
    return std::move(run_);
  }

 private:
  ScanMatching matching_{ScanMatchingParams{}};
  LocalMapBuilder builder_{LocalMapBuilderParams{}};
  MappedRun run_;
};

/// Path length up to each pose.
std::vector<double> odometer_of(const Trajectory& trajectory) {
  std::vector<double> odometer{0.0};
  for (std::size_t i = 1; i < trajectory.size(); ++i) {
    const Pose2 step = between(trajectory[i - 1].pose, trajectory[i].pose);
    odometer.push_back(odometer.back() + step.translation().norm());
  }
  return odometer;
}

/// Indices of poses about 1 m apart.
std::vector<std::size_t> sample_stops(const std::vector<double>& odometer) {
  std::vector<std::size_t> stops;
  for (std::size_t i = 0; i < odometer.size(); ++i) {
    if (stops.empty() || odometer[i] - odometer[stops.back()] >= 1.0) stops.push_back(i);
  }
  return stops;
}

std::vector<Relation> relations_of(const Trajectory& truth) {
  constexpr double kRevisitM = 1.5;
  constexpr double kElsewhereM = 15.0;
  const auto odometer = odometer_of(truth);
  const auto stops = sample_stops(odometer);
  std::vector<Relation> relations;
  const auto relate = [&](std::size_t i, std::size_t j) {
    relations.push_back({truth[i].utime, truth[j].utime, between(truth[i].pose, truth[j].pose)});
  };
  for (const std::size_t i : stops) {
    for (const double path_length_m : {5.0, 20.0, 50.0}) {
      const auto j =
          std::lower_bound(odometer.begin(), odometer.end(), odometer[i] + path_length_m);
      if (j != odometer.end()) relate(i, j - odometer.begin());
    }
    for (const std::size_t j : stops) {
      const double apart = (truth[i].pose.translation() - truth[j].pose.translation()).norm();
      if (odometer[j] - odometer[i] > kElsewhereM && apart < kRevisitM) relate(i, j);
    }
  }
  return relations;
}

std::size_t index_of(const Trajectory& trajectory, std::int64_t utime) {
  const auto after = std::lower_bound(trajectory.begin(), trajectory.end(), utime,
                                      [](const auto& p, std::int64_t t) { return p.utime < t; });
  if (after == trajectory.end()) return trajectory.size() - 1;
  const auto i = static_cast<std::size_t>(after - trajectory.begin());
  return i > 0 && utime - trajectory[i - 1].utime < after->utime - utime ? i - 1 : i;
}

/// Distance of an interpolated pose from the pose of the nearest scan.
struct InterpolationDistance {
  double m = 0.0;
  double rad = 0.0;

  [[nodiscard]] bool small() const { return m < 0.03 && rad < 0.02; }
};

InterpolationDistance interpolation_distance(const Trajectory& trajectory, std::int64_t utime) {
  const std::size_t i = index_of(trajectory, utime);
  const auto T_odom_here = interpolate(trajectory, utime);
  if (!T_odom_here) return {};
  const Pose2 difference = between(trajectory[i].pose, *T_odom_here);
  return {difference.translation().norm(), std::abs(difference.theta)};
}

bool is_accurate(const Trajectory& trajectory, const Relation& relation) {
  return interpolation_distance(trajectory, relation.utime_1).small() &&
         interpolation_distance(trajectory, relation.utime_2).small();
}

}  // namespace

Pose2 MappedRun::pose_in_map(int map, std::int64_t utime) const {
  return between(maps[map].T_odom_local, *interpolate(odom, utime));
}

int MappedRun::map_at(std::int64_t utime) const {
  if (!interpolate(odom, utime)) return -1;
  for (int i = 0; i < static_cast<int>(maps.size()); ++i) {
    if (utime >= maps[i].utime && utime <= maps[i].end_utime) return i;
  }
  return -1;
}

MappedRun map_recording(const std::filesystem::path& log, const std::filesystem::path& relations,
                        bool use_odometry) {
  Mapper mapper;
  CarmenReader reader(log);
  while (const auto record = reader.next()) {
    if (const auto* scan = std::get_if<CarmenScan>(&*record)) {
      mapper.add(scan->scan);
    } else if (use_odometry) {
      mapper.add(std::get<WheelOdometry>(*record));
    }
  }
  MappedRun run = mapper.finish();
  run.relations = read_relations(relations);
  return run;
}

MappedRun map_corrected(const std::filesystem::path& log) {
  Mapper mapper;
  CarmenReader reader(log);
  Trajectory path;
  while (const auto record = reader.next()) {
    const auto* scan = std::get_if<CarmenScan>(&*record);
    if (scan == nullptr || (!path.empty() && scan->scan.utime <= path.back().utime)) continue;
    path.push_back({scan->scan.utime, scan->T_log_laser});
    mapper.add(scan->scan);
  }
  MappedRun run = mapper.finish();
  run.relations = relations_of(path);
  return run;
}

MappedRun map_sample(int seed, bool half_degree, bool use_odometry) {
  Mapper mapper;
  SampleRun sample({.seed = seed, .beams = half_degree ? 361 : 181});
  while (const auto reading = sample.next()) {
    if (use_odometry) mapper.add(reading->odometry);
    mapper.add(reading->scan);
  }
  MappedRun run = mapper.finish();
  run.relations = relations_of(sample.truth());
  return run;
}

TruePairs true_pairs(const MappedRun& run) {
  constexpr int kNeighbours = 3;
  TruePairs pairs;
  for (const Relation& relation : run.relations) {
    int older = run.map_at(relation.utime_1);
    int newer = run.map_at(relation.utime_2);
    if (older < 0 || newer < 0 || std::abs(newer - older) < kNeighbours) continue;
    if (relation.T_1_2.translation().norm() > 5.0 || !is_accurate(run.odom, relation)) continue;
    Pose2 T_older_newer = run.pose_in_map(older, relation.utime_1) * relation.T_1_2 *
                          run.pose_in_map(newer, relation.utime_2).inverse();
    if (older > newer) {
      std::swap(older, newer);
      T_older_newer = T_older_newer.inverse();
    }
    pairs.emplace(std::pair{older, newer}, T_older_newer);
  }
  return pairs;
}

Scatter scatter_of_relations(const MappedRun& run) {
  constexpr double kShortM = 2.0;
  constexpr double kToSd = 1.4826;  // from the median of |x| to σ, normal distribution
  const auto odometer = odometer_of(run.odom);
  std::vector<double> metres;
  std::vector<double> radians;
  for (const Relation& relation : run.relations) {
    const auto from = interpolate(run.odom, relation.utime_1);
    const auto to = interpolate(run.odom, relation.utime_2);
    if (!from || !to || !is_accurate(run.odom, relation)) continue;
    const double path_length_m = odometer[index_of(run.odom, relation.utime_2)] -
                                 odometer[index_of(run.odom, relation.utime_1)];
    if (std::abs(path_length_m) > kShortM) continue;
    const Pose2 error = between(relation.T_1_2, between(*from, *to));
    metres.push_back(std::abs(error.x));
    metres.push_back(std::abs(error.y));
    radians.push_back(std::abs(error.theta));
  }
  return {kToSd * median(metres), kToSd * median(radians)};
}

std::vector<DisplacementScore> score_displacements(const MappedRun& run,
                                                   const LocalMapBuilderParams& params) {
  std::vector<DisplacementScore> scores{{2.5, 8}, {8, 15}, {15, 30}, {30, 80}, {80, 250}};
  const auto odometer = odometer_of(run.odom);
  const Eigen::Matrix3d scatter = scatter_of_relations(run).covariance();
  for (DisplacementScore& score : scores) {
    std::vector<double> nees;
    for (const Relation& relation : run.relations) {
      const std::size_t i = index_of(run.odom, std::min(relation.utime_1, relation.utime_2));
      const std::size_t j = index_of(run.odom, std::max(relation.utime_1, relation.utime_2));
      const double path_length_m = odometer[j] - odometer[i];
      const auto from = interpolate(run.odom, relation.utime_1);
      const auto to = interpolate(run.odom, relation.utime_2);
      if (path_length_m < score.from_m || path_length_m >= score.to_m || !from || !to) continue;
      if (!is_accurate(run.odom, relation)) continue;
      DisplacementError model(params.error);
      for (std::size_t k = i + 1; k <= j; ++k) {
        const Pose2 step = between(run.odom[k - 1].pose, run.odom[k].pose);
        model.add_step(step, run.matches[k]);
        model.add_travel(step.translation().norm(), step.theta);
      }
      const bool forward = relation.utime_1 < relation.utime_2;
      const Pose2 truth = forward ? relation.T_1_2 : relation.T_1_2.inverse();
      const Pose2 estimated = forward ? between(*from, *to) : between(*to, *from);
      const Eigen::Matrix3d covariance = model.covariance();
      const Eigen::Vector3d error = between(truth, estimated).vector();
      nees.push_back(error.dot((covariance + scatter).inverse() * error));
      score.nees += nees.back();
      score.translation_m += error.head<2>().norm();
      score.rotation_deg += rad_to_deg(std::abs(error.z()));
      score.sd_m += std::sqrt(0.5 * covariance.topLeftCorner<2, 2>().trace());
      score.sd_deg += rad_to_deg(std::sqrt(covariance(2, 2)));
    }
    score.count = static_cast<int>(nees.size());
    const double n = std::max(1, score.count);
    for (double* sum :
         {&score.nees, &score.translation_m, &score.rotation_deg, &score.sd_m, &score.sd_deg}) {
      *sum /= n;
    }
    score.nees_median = median(nees);
  }
  return scores;
}

}  // namespace adit

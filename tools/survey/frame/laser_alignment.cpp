// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "tools/survey/frame/laser_alignment.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <set>

#include <Eigen/Cholesky>
#include <Eigen/Geometry>
#include <Eigen/LU>

#include "common/geometry/motion3.hpp"
#include "common/geometry/pose2.hpp"

namespace adit {
namespace {

using Matrix36d = Eigen::Matrix<double, 3, 6>;

constexpr double kMountSdRad = 0.03;      // of a mount
constexpr double kMatchYawSdRad = 0.002;  // of a match, beside the graph
constexpr double kHuber = 2.0;            // standard deviations
constexpr int kIterations = 10;
constexpr double kSignificance = 4.0;  // standard deviations
constexpr double kTolerableRad = 0.003;

bool is_front(const Cloud& cloud, const Lasers& lasers) {
  const Eigen::Vector2d at = cloud.lines.front().origin.head<2>().cast<double>();
  const auto off_m = [&](const LaserMount& mount) {
    return (at - mount.T_body_laser.translation()).norm();
  };
  return !lasers.has_rear() || off_m(lasers.front) < off_m(lasers.rear);
}

/// A match as an equation of the errors of the front and the rear laser (x, y, z each).
struct MountEquation {
  explicit MountEquation(const ScanRotation& match)
      : scans{match.older_utime, match.newer_utime}, remaining_rad(match.remaining_rad) {
    Eigen::Matrix3d turn = Eigen::Matrix3d::Identity();
    turn.topLeftCorner<2, 2>() = Eigen::Rotation2Dd(-match.turn_rad).toRotationMatrix();
    H.middleCols<3>(match.older_is_front ? 0 : 3) += turn;
    H.middleCols<3>(match.newer_is_front ? 0 : 3) -= Eigen::Matrix3d::Identity();
    information.topLeftCorner<2, 2>() = match.tilt_covariance.inverse();
    information(2, 2) = 1.0 / (kMatchYawSdRad * kMatchYawSdRad);
  }

  [[nodiscard]] double residual(const Vector6d& errors) const {
    const Eigen::Vector3d off = remaining_rad - H * errors;
    return std::sqrt(off.dot(information * off));
  }

  std::int64_t scans[2];
  Matrix36d H = Matrix36d::Zero();
  Eigen::Vector3d remaining_rad;
  Eigen::Matrix3d information = Eigen::Matrix3d::Zero();
  double weight = 1.0;
};

struct MountNormal {
  Matrix6d A = Matrix6d::Zero();
  Vector6d b = Vector6d::Zero();

  void add(const MountEquation& equation, double sign = 1.0) {
    const Eigen::Matrix<double, 6, 3> weighted =
        sign * equation.weight * equation.H.transpose() * equation.information;
    A += weighted * equation.H;
    b += weighted * equation.remaining_rad;
  }
  [[nodiscard]] Vector6d solved() const {
    constexpr double kPrior = 1.0 / (kMountSdRad * kMountSdRad);
    return (A + kPrior * Matrix6d::Identity()).ldlt().solve(b);
  }
};

MountNormal normal_of(const std::vector<MountEquation>& equations) {
  MountNormal normal;
  for (const MountEquation& equation : equations) normal.add(equation);
  return normal;
}

/// True less stated, of the front laser against the rear one.
Eigen::Vector3d difference(const Vector6d& errors) { return errors.tail<3>() - errors.head<3>(); }

/// Of a jackknife over scans: all matches of a scan share its errors.
Eigen::Vector3d spread(const std::vector<MountEquation>& equations, const MountNormal& all) {
  std::set<std::int64_t> scans;
  for (const MountEquation& equation : equations)
    scans.insert({equation.scans[0], equation.scans[1]});
  const Eigen::Vector3d estimate = difference(all.solved());
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  for (const std::int64_t scan : scans) {
    MountNormal others = all;
    for (const MountEquation& equation : equations) {
      if (equation.scans[0] == scan || equation.scans[1] == scan) others.add(equation, -1.0);
    }
    sum += (difference(others.solved()) - estimate).cwiseAbs2();
  }
  const auto n = static_cast<double>(scans.size());
  return ((n - 1.0) / n * sum).cwiseSqrt();
}

}  // namespace

std::vector<ScanRotation> scan_rotations(const std::vector<CloudMatch>& matches,
                                         const MapGraph& graph, const CloudStore& clouds,
                                         const Lasers& lasers) {
  std::map<std::int64_t, bool> front;  // by Cloud::utime
  for (std::size_t i = 0; i < clouds.size(); ++i) {
    const Cloud& cloud = clouds[i];
    if (!cloud.lines.empty()) front[cloud.utime] = is_front(cloud, lasers);
  }
  const auto has_pose = [&](int map) {
    return map >= 0 && map < static_cast<int>(graph.poses.size());
  };
  std::vector<ScanRotation> rotations;
  for (const CloudMatch& match : matches) {
    const auto older = front.find(match.older.utime);
    const auto newer = front.find(match.newer.utime);
    if (older == front.end() || newer == front.end()) continue;
    if (!has_pose(match.older.map) || !has_pose(match.newer.map)) continue;
    const auto pose = [&](int map) { return graph.poses[static_cast<std::size_t>(map)]; };
    const Pose2 T_older_newer = between(pose(match.older.map), pose(match.newer.map));
    ScanRotation rotation{match.older.utime, match.newer.utime, older->second, newer->second,
                          match.turn_rad};
    rotation.remaining_rad << match.tilt_rad,
        wrap_angle(match.T_older_newer.theta - T_older_newer.theta);
    rotation.tilt_covariance = match.tilt_covariance;
    rotations.push_back(rotation);
  }
  return rotations;
}

bool LaserAlignment::is_off(int axis) const {
  const double off_rad = std::abs(rotation_rad[axis]);
  return off_rad > kTolerableRad && off_rad > kSignificance * sd_rad[axis];
}

std::optional<LaserAlignment> laser_alignment(const std::vector<ScanRotation>& rotations) {
  LaserAlignment alignment;
  std::vector<MountEquation> equations;
  for (const ScanRotation& match : rotations) {
    equations.emplace_back(match);
    if (match.older_is_front != match.newer_is_front) ++alignment.matches;
  }
  if (alignment.matches < kAlignmentMatchesMin) return std::nullopt;
  Vector6d errors = Vector6d::Zero();
  for (int i = 0; i < kIterations; ++i) {
    errors = normal_of(equations).solved();
    for (MountEquation& equation : equations)
      equation.weight = std::min(1.0, kHuber / std::max(equation.residual(errors), 1e-9));
  }
  alignment.rotation_rad = difference(errors);
  alignment.sd_rad = spread(equations, normal_of(equations));
  return alignment;
}

}  // namespace adit

// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "tools/survey/compare/scan_placement.hpp"

#include <cstddef>
#include <limits>
#include <unordered_set>
#include <utility>

#include <Eigen/LU>

#include "tools/survey/points/point_index.hpp"

namespace adit {
namespace {

constexpr double kAroundM = 12.0;       // of a scan, from which others are its target
constexpr double kTargetVoxelM = 0.06;  // of a target, thinned
// Of a prior, beside what the surveys state: their starts are set up by hand, and a neighbour's
// correction is not that of the next scan.
constexpr double kPriorPlaceSdM = 0.05;
constexpr double kPriorTurnSdRad = 0.01;
constexpr double kPriorTiltSdRad = 0.003;

Matrix6d prior_covariance(const Matrix6d& stated) {
  Vector6d slack;
  slack << Eigen::Vector3d::Constant(kPriorPlaceSdM), kPriorTiltSdRad, kPriorTiltSdRad,
      kPriorTurnSdRad;
  return stated + Matrix6d(slack.cwiseAbs2().asDiagonal());
}

Vector6d motion_of(const Eigen::Isometry3d& T) {
  const Eigen::AngleAxisd turn(T.linear());
  Vector6d motion;
  motion << T.translation(), turn.angle() * turn.axis();
  return motion;
}

const SurveyedScan& nearest_scan(const SurveyedCloud& cloud, const Eigen::Vector3d& p) {
  const SurveyedScan* nearest = &cloud.scans.front();
  for (const SurveyedScan& scan : cloud.scans) {
    if ((scan.laser - p).squaredNorm() < (nearest->laser - p).squaredNorm()) nearest = &scan;
  }
  return *nearest;
}

/// What a survey shows around a place, as a cloud about it: a line for each scan.
Cloud cloud_around(const SurveyedCloud& survey, const Eigen::Vector3d& place) {
  Cloud cloud;
  std::unordered_set<std::uint64_t> taken;
  for (const SurveyedScan& scan : survey.scans) {
    const Eigen::Vector3d offset = scan.laser - place;
    if (offset.norm() > kAroundM) continue;
    CloudLine line;
    line.origin = offset.cast<float>();
    for (const Eigen::Vector3f& point : scan.points) {
      const Eigen::Vector3d p = point.cast<double>() + offset;
      if (taken.insert(voxel_key(p, kTargetVoxelM)).second) line.points.push_back(p.cast<float>());
    }
    cloud.lines.push_back(std::move(line));
  }
  return cloud;
}

Cloud cloud_of(const SurveyedScan& scan) {
  Cloud cloud;
  cloud.lines.push_back({0, {0.0F, 0.0F, 0.0F}, scan.points, {}});
  return cloud;
}

/// The correction of a scan, a motion of comparison, and where it was found.
struct FoundCorrection {
  Eigen::Vector3d laser;
  Eigen::Isometry3d motion;
};

Eigen::Isometry3d nearest_correction(const std::vector<FoundCorrection>& found,
                                     const Eigen::Vector3d& p) {
  Eigen::Isometry3d motion = Eigen::Isometry3d::Identity();
  double least = std::numeric_limits<double>::infinity();
  for (const FoundCorrection& at : found) {
    const double distance = (at.laser - p).squaredNorm();
    if (distance > least) continue;
    least = distance;
    motion = at.motion;
  }
  return motion;
}

}  // namespace

double variance_along(const Matrix6d& covariance, const Eigen::Vector3d& from_laser,
                      const Eigen::Vector3d& n) {
  Vector6d jacobian;
  jacobian << n, from_laser.cross(n);
  return jacobian.dot(covariance * jacobian);
}

double ScanPlacement::variance_along(const Eigen::Vector3d& p_comparison,
                                     const Eigen::Vector3d& n) const {
  return adit::variance_along(covariance, p_comparison - laser(), n);
}

std::vector<ScanPlacement> placed_by_coordinates(const SurveyedCloud& newer) {
  std::vector<ScanPlacement> placements;
  for (const SurveyedScan& scan : newer.scans) {
    ScanPlacement placement;
    placement.T_comparison_scan.translation() = scan.laser;
    placement.covariance = scan.covariance;
    placements.push_back(placement);
  }
  return placements;
}

std::vector<ScanPlacement> registered_scans(const SurveyedCloud& newer, const SurveyedCloud& older,
                                            const std::function<void(double done)>& progress) {
  const CloudRegistrationParams params;
  std::vector<ScanPlacement> placements;
  std::vector<FoundCorrection> found;
  for (const SurveyedScan& scan : newer.scans) {
    const Eigen::Translation3d T_comparison_given(scan.laser);
    const Eigen::Isometry3d T_prior = nearest_correction(found, scan.laser) * T_comparison_given;
    const SurveyedScan& beside = nearest_scan(older, T_prior.translation());
    const Matrix6d stated = scan.covariance + beside.covariance;
    const Matrix6d prior_information = prior_covariance(stated).inverse();
    // The target is placed about the expected place of the laser.
    const Eigen::Translation3d T_comparison_target(T_prior.translation());
    const CloudRegistration registration =
        register_clouds(RegistrationCloud(cloud_of(scan), params),
                        RegistrationCloud(cloud_around(older, T_prior.translation()), params),
                        {T_comparison_target.inverse() * T_prior, prior_information}, params);
    ScanPlacement placement;
    placement.registered = registration.accepted;
    placement.T_comparison_scan =
        registration.accepted ? T_comparison_target * registration.T_target_source : T_prior;
    placement.covariance =
        (prior_information + (registration.accepted ? registration.information : Matrix6d::Zero()))
            .inverse();
    const Vector6d motion = motion_of(T_comparison_given.inverse() * placement.T_comparison_scan);
    placement.moved_m = motion.head<3>().norm();
    if (registration.accepted) {
      placement.chi2 = motion.dot((stated + placement.covariance).inverse() * motion);
      found.push_back({scan.laser, placement.T_comparison_scan * T_comparison_given.inverse()});
    }
    placements.push_back(placement);
    if (progress)
      progress(static_cast<double>(placements.size()) / static_cast<double>(newer.scans.size()));
  }
  return placements;
}

}  // namespace adit

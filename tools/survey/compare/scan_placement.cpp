// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "tools/survey/compare/scan_placement.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <unordered_set>
#include <utility>

#include <Eigen/LU>

#include "tools/survey/compare/placement_network.hpp"
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
constexpr double kStepLengthMinM = 1.0;
constexpr double kStepSdM = 0.002;  // of a step, beside what the surveys state
constexpr double kStepSdRad = 0.0005;

Matrix6d prior_covariance(const Matrix6d& stated) {
  Vector6d slack;
  slack << Eigen::Vector3d::Constant(kPriorPlaceSdM), kPriorTiltSdRad, kPriorTiltSdRad,
      kPriorTurnSdRad;
  return stated + Matrix6d(slack.cwiseAbs2().asDiagonal());
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

Matrix6d covariance_of(double plan_sd_m, double z_sd_m, double tilt_sd_rad, double turn_sd_rad) {
  Vector6d sd;
  sd << plan_sd_m, plan_sd_m, z_sd_m, tilt_sd_rad, tilt_sd_rad, turn_sd_rad;
  return sd.cwiseAbs2().asDiagonal();
}

/// Of the place of a scan relative to the one before, as its survey states it; without the tilt,
/// since each scan is levelled by itself.
Matrix6d stated_step(const SurveyedScan& scan) {
  return covariance_of(scan.step_sd_m, scan.step_z_sd_m, 0.0, scan.step_turn_sd_rad);
}

/// The sum of the steps of a survey over their length.
Matrix6d steps_per_metre(const SurveyedCloud& survey) {
  double length_m = kStepLengthMinM;
  Matrix6d sum = Matrix6d::Zero();
  for (std::size_t i = 1; i < survey.scans.size(); ++i) {
    length_m += (survey.scans[i].laser - survey.scans[i - 1].laser).norm();
    sum += stated_step(survey.scans[i]);
  }
  return sum / length_m;
}

class PlacementSearch {
 public:
  PlacementSearch(const SurveyedCloud& newer, const SurveyedCloud& older)
      : newer_(newer), older_(older), older_steps_(steps_per_metre(older)) {}

  std::vector<ScanPlacement> run(const std::function<void(double done)>& progress) {
    const auto count = static_cast<double>(newer_.scans.size());
    for (std::size_t i = 0; i < newer_.scans.size(); ++i) {
      observe(i);
      if (progress) progress(0.9 * static_cast<double>(i + 1) / count);
    }
    std::vector<AdjustedPlacement> adjusted = adjust_placements(observed_);
    for (std::size_t i = 0; i < observed_.size(); ++i) {
      disagreed_.push_back(!observed_[i].information.isZero() && !adjusted[i].agrees);
      if (disagreed_.back()) observe_again(i, adjusted[i]);
    }
    if (std::ranges::find(disagreed_, true) != disagreed_.end())
      adjusted = adjust_placements(observed_);
    if (progress) progress(1.0);
    return placements_of(adjusted);
  }

 private:
  /// Registers a scan from a motion. `information` of that motion. Nothing found: an information of
  /// zero.
  void register_scan(std::size_t i, const Vector6d& motion, const Matrix6d& information) {
    const SurveyedScan& scan = newer_.scans[i];
    const Eigen::Isometry3d T_prior = Eigen::Translation3d(scan.laser) * isometry_of(motion);
    // The target is placed about the expected place of the laser.
    const Eigen::Translation3d T_comparison_target(T_prior.translation());
    const CloudRegistration registration =
        register_clouds(RegistrationCloud(cloud_of(scan), params_),
                        RegistrationCloud(cloud_around(older_, T_prior.translation()), params_),
                        {T_comparison_target.inverse() * T_prior, information}, params_);
    ObservedPlacement& observed = observed_[i];
    observed.information.setZero();
    if (!registration.accepted) return;
    const Eigen::Isometry3d T_found = T_comparison_target * registration.T_target_source;
    observed.registered = motion_of(Eigen::Translation3d(-scan.laser) * T_found);
    observed.information = registration.information;
  }

  void observe(std::size_t i) {
    const SurveyedScan& scan = newer_.scans[i];
    const SurveyedScan& beside = nearest_scan(older_, scan.laser);
    ObservedPlacement& observed = observed_.emplace_back();
    observed.laser = scan.laser;
    observed.prior_information = prior_covariance(scan.covariance + beside.covariance).inverse();
    if (i > 0) observed.step_covariance = step_to(i);
    register_scan(i, start_of(i), observed.prior_information);
  }

  /// With the motion that its neighbours give: what moved is then an outlier of the registration.
  void observe_again(std::size_t i, const AdjustedPlacement& neighbours) {
    register_scan(i, neighbours.motion, neighbours.covariance.inverse());
  }

  /// The motion of the nearest scan that was registered, as one of this scan.
  [[nodiscard]] Vector6d start_of(std::size_t i) const {
    Vector6d motion = Vector6d::Zero();
    double least = std::numeric_limits<double>::infinity();
    for (std::size_t k = 0; k < i; ++k) {
      const Eigen::Vector3d offset = observed_[i].laser - observed_[k].laser;
      if (observed_[k].information.isZero() || offset.norm() >= least) continue;
      least = offset.norm();
      motion = observed_[k].registered;
      motion.head<3>() += Eigen::Vector3d(motion.tail<3>()).cross(offset);
    }
    return motion;
  }

  /// Of the step from the scan before, by both surveys.
  [[nodiscard]] Matrix6d step_to(std::size_t i) const {
    const SurveyedScan& scan = newer_.scans[i];
    const SurveyedScan& before = newer_.scans[i - 1];
    const double length_m = (scan.laser - before.laser).norm();
    // Each scan is levelled by itself.
    const Matrix6d older =
        nearest_scan(older_, scan.laser).covariance + nearest_scan(older_, before.laser).covariance;
    const Matrix6d own = scan.covariance + before.covariance;
    const Matrix6d tilt = covariance_of(0.0, 0.0, std::sqrt(own(3, 3) + older(3, 3)), 0.0);
    return stated_step(scan) + length_m * older_steps_ + tilt +
           covariance_of(kStepSdM, kStepSdM, kStepSdRad, kStepSdRad);
  }

  [[nodiscard]] std::vector<ScanPlacement> placements_of(
      const std::vector<AdjustedPlacement>& adjusted) const {
    std::vector<ScanPlacement> placements;
    for (std::size_t i = 0; i < adjusted.size(); ++i) {
      const SurveyedScan& scan = newer_.scans[i];
      ScanPlacement placement;
      placement.registered = adjusted[i].agrees;
      placement.disagreed = disagreed_[i];
      placement.T_comparison_scan =
          Eigen::Translation3d(scan.laser) * isometry_of(adjusted[i].motion);
      placement.covariance = adjusted[i].covariance;
      placement.moved_m = adjusted[i].motion.head<3>().norm();
      if (placement.registered) {
        const Matrix6d stated =
            scan.covariance + nearest_scan(older_, scan.laser).covariance + placement.covariance;
        placement.chi2 = adjusted[i].motion.dot(stated.inverse() * adjusted[i].motion);
      }
      placements.push_back(placement);
    }
    return placements;
  }

  const SurveyedCloud& newer_;
  const SurveyedCloud& older_;
  CloudRegistrationParams params_;
  Matrix6d older_steps_;  // per metre
  std::vector<ObservedPlacement> observed_;
  std::vector<bool> disagreed_;
};

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
  return PlacementSearch(newer, older).run(progress);
}

}  // namespace adit

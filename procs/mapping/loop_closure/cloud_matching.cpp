// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "procs/mapping/loop_closure/cloud_matching.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <utility>

#include <Eigen/Cholesky>
#include <Eigen/LU>

#include "common/geometry/attitude.hpp"
#include "common/geometry/symmetric_eigen.hpp"
#include "procs/mapping/association/odometry_chain.hpp"

namespace adit {
namespace {

constexpr double kUnconstrainedSd = 10.0;  // [m, rad] of a direction that the match leaves open
constexpr double kLikelihoodMax = 50.0;
constexpr double kRivalLikelihood = 20.0;  // less than the best place; a rival is an alternative
constexpr std::size_t kAlternativesMax = 4;

/// Of (x, y, θ), where z and the rotations about x and y are those of the prior within its
/// information (Schur complement).
Eigen::Matrix3d planar_information(const Matrix6d& information, const Matrix6d& prior) {
  constexpr int kPlanar[] = {0, 1, 5};
  constexpr int kOther[] = {2, 3, 4};
  Eigen::Matrix3d planar, other, mixed;
  for (int i = 0; i < 3; ++i) {
    for (int k = 0; k < 3; ++k) {
      planar(i, k) = information(kPlanar[i], kPlanar[k]);
      mixed(i, k) = information(kPlanar[i], kOther[k]);
      other(i, k) = information(kOther[i], kOther[k]) + prior(kOther[i], kOther[k]);
    }
  }
  const Eigen::Matrix3d reduced = planar - mixed * other.ldlt().solve(mixed.transpose());
  return 0.5 * (reduced + reduced.transpose()) +
         Eigen::Matrix3d::Identity() / (kUnconstrainedSd * kUnconstrainedSd);
}

SymmetricEigen<2> axes_in_plan(const Eigen::Matrix3d& covariance) {
  return symmetric_eigen(Eigen::Matrix2d(covariance.topLeftCorner<2, 2>()));
}

/// Of the horizontal directions from the laser; zero for a scan of the full circle.
Eigen::Vector2d mean_direction(const Cloud& cloud) {
  Eigen::Vector2d sum = Eigen::Vector2d::Zero();
  for (const CloudLine& line : cloud.lines) {
    for (const Eigen::Vector3f& p : line.points) {
      const Eigen::Vector2d direction = (p - line.origin).head<2>().cast<double>();
      sum += direction.stableNormalized();
    }
  }
  return sum / static_cast<double>(std::max<std::size_t>(1, cloud.points()));
}

}  // namespace

void CloudMatching::add(const Cloud& cloud, int session, const CloudPlace& place,
                        const Pose2& T_local_level) {
  if (params_.stored_max == 0) return;
  scans_.push_back({session, place, T_local_level, mean_direction(cloud),
                    RegistrationCloud(cloud, params_.registration)});
  while (scans_.size() > static_cast<std::size_t>(params_.stored_max)) scans_.pop_front();
}

void CloudMatching::discard(int map) {
  std::erase_if(scans_, [&](const Scan& scan) { return scan.place.map == map; });
  for (Scan& scan : scans_) {
    if (scan.place.map > map) --scan.place.map;
  }
}

std::vector<MatchedClouds> CloudMatching::matches(
    int map, const std::function<PlacedLocalMap(int map)>& place_of,
    const RelativeCovariance& covariance_of) const {
  std::vector<MatchedClouds> found;
  for (const Scan& newer : scans_) {
    if (newer.place.map != map) continue;
    const PlacedLocalMap newer_map = place_of(map);
    const Pose2 T_map_newer = newer_map.T_map_local * newer.T_local_level;
    const Eigen::Matrix3d to_level = adjoint(newer.T_local_level.inverse());
    std::vector<Pair> pairs;
    for (const Scan& older : scans_) {
      if (older.place.map >= map || older.session != newer.session) continue;
      const PlacedLocalMap older_map = place_of(older.place.map);
      const Pose2 T_older_newer = between(older_map.T_map_local * older.T_local_level, T_map_newer);
      if (T_older_newer.translation().norm() > params_.distance_max_m) continue;
      pairs.push_back({&newer, &older, T_older_newer,
                       newer_map.z_m + newer.place.z_m - older_map.z_m - older.place.z_m,
                       Eigen::Matrix3d::Zero()});
    }
    std::ranges::stable_sort(pairs, {}, [](const Pair& pair) -> double {
      return pair.T_older_newer.translation().norm();
    });
    if (pairs.size() > static_cast<std::size_t>(params_.matched_max)) {
      pairs.resize(static_cast<std::size_t>(params_.matched_max));
    }
    for (Pair& pair : pairs) {
      if (covariance_of) {
        pair.covariance = to_level * covariance_of(pair.older->place.map) * to_level.transpose();
      }
      auto matched = match(pair);
      if (matched) found.push_back(std::move(*matched));
    }
  }
  return found;
}

std::vector<CloudPlace> CloudMatching::places(int map) const {
  std::vector<CloudPlace> found;
  for (const Scan& scan : scans_) {
    if (scan.place.map == map) found.push_back(scan.place);
  }
  return found;
}

bool CloudMatching::look_at_each_other(const Scan& newer, const Scan& older,
                                       const Pose2& T_older_newer) const {
  const Eigen::Vector2d view = Eigen::Rotation2Dd(T_older_newer.theta) * newer.view;
  return older.view.dot(view) < params_.view_cosine_min * older.view.norm() * view.norm();
}

/// Covariance of what a match is not used for, in the frame of the newer scan, and the least along
/// the displacement.
Eigen::Matrix3d CloudMatching::beside_displacement(const Pose2& T_older_newer) const {
  const Eigen::Vector2d along =
      Eigen::Rotation2Dd(-T_older_newer.theta) * T_older_newer.translation().stableNormalized();
  const Eigen::Vector2d across(-along.y(), along.x());
  Eigen::Matrix3d covariance = Eigen::Matrix3d::Zero();
  covariance.topLeftCorner<2, 2>() =
      params_.across_sd_m * params_.across_sd_m * across * across.transpose() +
      params_.displacement_floor_m * params_.displacement_floor_m * along * along.transpose();
  covariance(2, 2) = params_.turn_sd_rad * params_.turn_sd_rad;
  return covariance;
}

/// Along each axis in plan the standard deviation is at least that of `params`.
CloudPrior CloudMatching::prior_of(const Pair& pair) const {
  CloudPrior prior;
  prior.T_target_source = in_space(pair.T_older_newer, pair.rise_m, Attitude{});
  const double sd_m =
      params_.prior_sd_m + params_.prior_sd_per_m * pair.T_older_newer.translation().norm();
  Vector6d sd;
  sd << sd_m, sd_m, params_.height_sd_m, params_.level_sd_rad, params_.level_sd_rad,
      params_.prior_sd_rad;
  prior.information = sd.cwiseAbs2().cwiseInverse().asDiagonal();
  const SymmetricEigen<2> axes = axes_in_plan(pair.covariance);
  const Eigen::Vector2d variances = axes.values.cwiseMax(sd_m * sd_m);
  prior.information.topLeftCorner<2, 2>() =
      axes.vectors * variances.cwiseInverse().asDiagonal() * axes.vectors.transpose();
  return prior;
}

/// Along the axis in plan of which the prior is least sure.
std::vector<Eigen::Isometry3d> CloudMatching::starts(const Pair& pair,
                                                     const CloudPrior& prior) const {
  const SymmetricEigen<2> axes = axes_in_plan(pair.covariance);
  const double widest_sd_m = std::sqrt(axes.values.y());
  const double reach_m = std::min(params_.start_max_m, params_.start_sds * widest_sd_m);
  const int steps = widest_sd_m > params_.start_step_m
                        ? static_cast<int>(std::ceil(reach_m / params_.start_step_m))
                        : 0;
  std::vector<Eigen::Isometry3d> starts{prior.T_target_source};
  for (int i = 1; i <= steps; ++i) {
    for (const double direction : {-1.0, 1.0}) {
      Vector6d offset = Vector6d::Zero();
      offset.head<2>() = direction * i * params_.start_step_m * axes.vectors.col(1);
      starts.push_back(prior.T_target_source * isometry_of(offset));
    }
  }
  return starts;
}

/// Those that were accepted at different places, the best first: by the share of inliers, as scans
/// have more in common the nearer they seem to be.
std::vector<CloudRegistration> CloudMatching::registrations(const Pair& pair,
                                                            const CloudPrior& prior) const {
  std::vector<CloudRegistration> found;
  for (const Eigen::Isometry3d& start : starts(pair, prior)) {
    CloudRegistration matched = register_clouds(pair.newer->surfaces, pair.older->surfaces, prior,
                                                params_.registration, start);
    if (matched.accepted) found.push_back(std::move(matched));
  }
  std::ranges::stable_sort(found, std::greater{}, &CloudRegistration::inlier_share);
  std::vector<CloudRegistration> places;
  for (CloudRegistration& matched : found) {
    const bool known = std::ranges::any_of(places, [&](const CloudRegistration& other) {
      const Eigen::Vector3d apart =
          other.T_target_source.translation() - matched.T_target_source.translation();
      return apart.head<2>().norm() < 0.5 * params_.start_step_m;
    });
    if (!known) places.push_back(std::move(matched));
  }
  return places;
}

LoopClosureAlternative CloudMatching::alternative(const Pair& pair, const CloudPrior& prior,
                                                  const CloudRegistration& matched) const {
  const Pose2 T_levels = in_plan(matched.T_target_source);
  const auto placed = [&](const Scan& scan) {
    const double variance = params_.place_m_per_sqrt_m * params_.place_m_per_sqrt_m *
                            scan.T_local_level.translation().norm();
    return Eigen::Vector3d(variance, variance, 0.0).asDiagonal().toDenseMatrix();
  };
  const UncertainPose T_older_level{pair.older->T_local_level, placed(*pair.older)};
  const UncertainPose T_level_newer{pair.newer->T_local_level.inverse(), placed(*pair.newer)};
  const double share = look_at_each_other(*pair.newer, *pair.older, pair.T_older_newer)
                           ? params_.facing_variance_share
                           : params_.displacement_variance_share;
  Eigen::Matrix3d covariance =
      share * planar_information(matched.information, prior.information).inverse();
  covariance += beside_displacement(T_levels);
  const UncertainPose between_maps =
      T_older_level * UncertainPose{T_levels, covariance} * T_level_newer;
  LoopClosureAlternative alternative;
  alternative.older_map = pair.older->place.map;
  alternative.T_older_newer = between_maps.T_from_to;
  alternative.information = between_maps.covariance.inverse();
  return alternative;
}

std::optional<MatchedClouds> CloudMatching::match(const Pair& pair) const {
  const CloudPrior prior = prior_of(pair);
  const std::vector<CloudRegistration> found = registrations(pair, prior);
  if (found.empty()) return std::nullopt;
  MatchedClouds result;
  result.loop_closure.newer_map = pair.newer->place.map;
  std::vector<LoopClosureAlternative>& alternatives = result.loop_closure.alternatives;
  const CloudRegistration& matched = found.front();
  const double patches = params_.registration.patches_per_measurement;
  const double best = std::min(kLikelihoodMax, matched.inliers / patches);
  for (const CloudRegistration& other : found) {
    alternatives.push_back(alternative(pair, prior, other));
    const double outliers = (matched.inlier_share - other.inlier_share) * matched.residuals;
    alternatives.back().log_likelihood = best - outliers / patches;
  }
  std::erase_if(alternatives, [&](const LoopClosureAlternative& place) {
    return place.log_likelihood < alternatives.front().log_likelihood - kRivalLikelihood;
  });
  if (alternatives.size() > kAlternativesMax) alternatives.resize(kAlternativesMax);
  const Pose2 T_levels = in_plan(matched.T_target_source);
  CloudMatch& match = result.match;
  match.older = pair.older->place;
  match.newer = pair.newer->place;
  match.T_older_newer = alternatives.front().T_older_newer;
  match.turn_rad = T_levels.theta;
  match.lever_m = T_levels.translation();
  const Matrix6d covariance_6d = (matched.information + prior.information).inverse();
  match.rise_m = matched.T_target_source.translation().z();
  match.rise_sd_m =
      std::hypot(std::sqrt(covariance_6d(2, 2)), params_.attitude_sd_rad * match.lever_m.norm());
  const Eigen::AngleAxisd tilt(
      Eigen::AngleAxisd(-T_levels.theta, Eigen::Vector3d::UnitZ()).toRotationMatrix() *
      matched.T_target_source.linear());
  match.tilt_rad = tilt.angle() * tilt.axis().head<2>();
  match.tilt_covariance =
      params_.tilt_variance_share * covariance_6d.block<2, 2>(3, 3) +
      2.0 * params_.attitude_sd_rad * params_.attitude_sd_rad * Eigen::Matrix2d::Identity();
  return result;
}

}  // namespace adit

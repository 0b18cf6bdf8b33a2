// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <deque>
#include <functional>
#include <optional>
#include <vector>

#include "common/config/bounds.hpp"
#include "common/geometry/pose2.hpp"
#include "common/registration/cloud_registration.hpp"
#include "common/types/association.hpp"
#include "common/types/cloud.hpp"
#include "common/types/cloud_match.hpp"

namespace adit {

struct CloudMatchingParams {
  /// Of pairs of 3D scans of random mines the errors along the displacement had 0.3 to 1.4 times
  /// the variance that follows (cloud_matching_table).
  CloudRegistrationParams registration{.coarse_m = 0.4,
                                       .fine_m = 0.15,
                                       .range_max_m = 20.0,
                                       .patches_per_measurement = 20.0,
                                       .spurious_ratio = 1.0,
                                       .sd_max_m = 0.2};
  double distance_max_m = 12.0;  ///< between two 3D scans that are matched
  int matched_max = 3;           ///< earlier scans that one is matched with, the nearest first
  int stored_max = 100;          ///< 3D scans in memory, about 1.4 MB each; 0: none are matched
  double prior_sd_m = 0.03;      ///< of the displacement before the match at least,
  double prior_sd_per_m = 0.03;  ///< and its growth with the distance
  /// A match ends at the nearest place that fits somewhat. Where the place before it is less sure
  /// than this, it begins at several: from one to the next,
  double start_step_m = 0.15;
  double start_sds = 2.5;       ///< to so many standard deviations to either side,
  double start_max_m = 3.0;     ///< and no farther
  double prior_sd_rad = 0.005;  ///< of its turn
  double height_sd_m = 0.1;     ///< of its rise
  /// Of the attitude from 3D scan to 3D scan, without its constant error.
  double attitude_sd_rad = 0.0005;
  /// Shares of the variance of the registration, in which errors agree over many patches: of the
  /// displacement, and of the tilt of two level frames.
  double displacement_variance_share = 0.25;
  double tilt_variance_share = 0.2;
  /// Of both, and of the attitude, for a spinning lidar: its few rings show the surfaces along
  /// lines only, and gravity is measured for one second instead of a sweep.
  double lidar_variance_factor = 9.0;
  /// Cosine between the mean directions of view of two 3D scans. Below, they look at each other:
  /// each sees the sides of the same stones that the other does not, and errs by up to 0.4 m.
  double view_cosine_min = -0.2;
  double facing_variance_share = 25.0;   ///< of the displacement of such scans
  double level_sd_rad = 0.01;            ///< of the relative roll and pitch of two level frames
  double displacement_floor_m = 0.0025;  ///< minimum standard deviation of the displacement
  /// Across the displacement, and of its turn, planar scans are more accurate: the match errs alike
  /// from 3D scan to 3D scan, by 0.5 mrad on average.
  double across_sd_m = 0.05;
  double turn_sd_rad = 0.01;
  /// Random walk of the body between the origin of its local map and the 3D scan.
  double place_m_per_sqrt_m = 0.03;

  template <class V>
  void visit(V& v) {
    v("registration", registration);
    v("distance_max_m", distance_max_m, within(0.0, 100.0));
    v("matched_max", matched_max, within(0, 100));
    v("stored_max", stored_max, within(0, 10000));
    v("prior_sd_m", prior_sd_m, within(1e-3, 10.0));
    v("prior_sd_per_m", prior_sd_per_m, within(0.0, 1.0));
    v("start_step_m", start_step_m, within(0.01, 10.0));
    v("start_sds", start_sds, within(0.0, 10.0));
    v("start_max_m", start_max_m, within(0.0, 20.0));
    v("prior_sd_rad", prior_sd_rad, within(1e-4, 1.0));
    v("height_sd_m", height_sd_m, within(1e-3, 10.0));
    v("attitude_sd_rad", attitude_sd_rad, within(1e-6, 1.0));
    v("displacement_variance_share", displacement_variance_share, within(1e-3, 10.0));
    v("tilt_variance_share", tilt_variance_share, within(1e-3, 10.0));
    v("lidar_variance_factor", lidar_variance_factor, within(1e-3, 1e3));
    v("view_cosine_min", view_cosine_min, within(-1.0, 1.0));
    v("facing_variance_share", facing_variance_share, within(1e-3, 1e6));
    v("level_sd_rad", level_sd_rad, within(1e-4, 1.0));
    v("displacement_floor_m", displacement_floor_m, within(0.0, 1.0));
    v("across_sd_m", across_sd_m, within(0.0, 10.0));
    v("turn_sd_rad", turn_sd_rad, within(0.0, 1.0));
    v("place_m_per_sqrt_m", place_m_per_sqrt_m, within(0.0, 1.0));
  }
};

/// The pose of a local map in the map, with its height.
struct PlacedLocalMap {
  Pose2 T_map_local;
  double z_m = 0.0;
};

/// Two 3D scans that were matched.
struct MatchedClouds {
  LoopClosure loop_closure;  ///< between their local maps
  CloudMatch match;
};

/// Matches 3D scans with each other. Floor and roof show the motion along a tunnel whose walls are
/// smooth, where planar scans leave it to the wheels: between two scans 8 m apart wheels erred by
/// up to 0.24 m, matches of 3D scans by 0.01 m. Walls that repeat fit at several places, each of
/// which is an alternative.
class CloudMatching {
 public:
  explicit CloudMatching(const CloudMatchingParams& params) : params_(params) {}

  /// Adds a 3D scan, in order of time. `T_local_level`: its frame level in its local map.
  void add(const Cloud& cloud, int session, const CloudPlace& place, const Pose2& T_local_level);
  /// A local map was discarded, and the one after it has its id.
  void discard(int map);

  /// Covariance of the pose of a local map in an older one: of (x, y, θ) in the frame of the newer.
  using RelativeCovariance = std::function<Eigen::Matrix3d(int older)>;

  /// Matches the 3D scans of a local map with earlier ones of other local maps of the same session.
  /// Without `covariance_of` the places are as sure as the parameters say.
  [[nodiscard]] std::vector<MatchedClouds> matches(
      int map, const std::function<PlacedLocalMap(int map)>& place_of,
      const RelativeCovariance& covariance_of = {}) const;
  /// Where the 3D scans of a local map were taken.
  [[nodiscard]] std::vector<CloudPlace> places(int map) const;

 private:
  struct Scan {
    int session;
    CloudPlace place;
    Pose2 T_local_level;
    Eigen::Vector2d view;  ///< mean of the horizontal directions to its points, in level
    RegistrationCloud surfaces;
  };
  [[nodiscard]] bool look_at_each_other(const Scan& newer, const Scan& older,
                                        const Pose2& T_older_newer) const;
  [[nodiscard]] Eigen::Matrix3d beside_displacement(const Pose2& T_older_newer) const;
  /// Two 3D scans, with the pose of the newer level frame in the older one before the match.
  struct Pair {
    const Scan* newer;
    const Scan* older;
    Pose2 T_older_newer;
    double rise_m;
    Eigen::Matrix3d covariance;  ///< of (x, y, θ) in the newer
  };
  [[nodiscard]] CloudPrior prior_of(const Pair& pair) const;
  [[nodiscard]] std::vector<Eigen::Isometry3d> starts(const Pair& pair,
                                                      const CloudPrior& prior) const;
  [[nodiscard]] std::vector<CloudRegistration> registrations(const Pair& pair,
                                                             const CloudPrior& prior) const;
  [[nodiscard]] LoopClosureAlternative alternative(const Pair& pair, const CloudPrior& prior,
                                                   const CloudRegistration& matched) const;
  [[nodiscard]] std::optional<MatchedClouds> match(const Pair& pair) const;

  CloudMatchingParams params_;
  std::deque<Scan> scans_;  ///< oldest first
};

}  // namespace adit

// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "procs/mapping/loop_closure/map_matching.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <limits>
#include <memory>
#include <numbers>
#include <optional>
#include <utility>

#include <Eigen/Geometry>
#include <Eigen/LU>

#include "common/geometry/symmetric_eigen.hpp"

namespace adit {
namespace {

constexpr double kDistinctM = 0.3;  // closer alternatives are the same
constexpr double kDistinctRad = 0.1;
constexpr double kOpenRatio = 5.0;  // of the standard deviations along a tunnel and across it
constexpr double kAlongCosine = 0.95;
constexpr int kFewPoints = 120;  // to test a peak before its refinement
constexpr int kFewIterations = 12;
constexpr double kCoarseSearchM = 4.0;  // wider gates are searched at half the resolution
constexpr double kCoarseSearchRad = 1.0;

/// Root mean square distance of the points: the mean displacement per radian of turn.
double lever_arm_m(const std::vector<SurfacePoint>& points) {
  double squares = 0.0;
  for (const auto& point : points) squares += point.p.squaredNorm();
  return std::max(0.5, std::sqrt(squares / static_cast<double>(points.size())));
}

std::vector<SurfacePoint> evenly_sampled(const std::vector<SurfacePoint>& points, int most) {
  const std::size_t n = points.size();
  const std::size_t m = std::min(n, static_cast<std::size_t>(most));
  std::vector<SurfacePoint> chosen;
  chosen.reserve(m);
  for (std::size_t i = 0; i < m; ++i) chosen.push_back(points[i * n / m]);
  return chosen;
}

/// The points without their heights. Alignment compares maps whose heights differ by an unknown
/// offset, and walls are expected to be vertical.
std::vector<SurfacePoint> flat(std::vector<SurfacePoint> points) {
  for (SurfacePoint& point : points) point.z_m = 0.0;
  return points;
}

struct FineMatch {
  PointToLineResult match;
  Eigen::Matrix3d neighbours_covariance;  ///< that their places add to its error
};

/// The matching of two maps.
class MapMatcher {
 public:
  MapMatcher(const LocalWalls& newer, const std::vector<PlacedWalls>& older,
             const RelativePose& predicted, const MapMatchingParams& params)
      : params_(params),
        predicted_(predicted),
        newer_points_(evenly_sampled(newer.points, params.points_max)),
        few_points_(evenly_sampled(newer.points, kFewPoints)),
        newer_flat_(flat(newer_points_)),
        few_flat_(flat(few_points_)),
        newer_path_(newer.path),
        newer_(SurfelMapParams{}, SurfelMap::Buckets::kOfOneLocalMap),
        newer_views_(newer.views),
        older_walls_(older.empty() ? nullptr : older.front().walls),
        older_(SurfelMapParams{}, SurfelMap::Buckets::kOfOneLocalMap),
        older_alone_(SurfelMapParams{}, SurfelMap::Buckets::kOfOneLocalMap) {
    newer_.insert(flat(newer.points), {}, 0.0);
    for (const PlacedWalls& placed : older) {
      placed_.push_back({placed.T_older_walls, placed.covariance});
      older_.insert(flat(placed.walls->points), placed.T_older_walls, 0.0);
      for (const auto& view : placed.walls->views) {
        older_views_.push_back({view.free_space.raised(placed.z_older_walls_m),
                                placed.T_older_walls * view.T_local_body});
      }
      for (const auto& [p, forward_m] : placed.walls->path) {
        const Eigen::Vector2d there = placed.T_older_walls * Eigen::Vector2d(p.head<2>());
        older_path_.push_back({{there.x(), there.y(), p.z() + placed.z_older_walls_m}, forward_m});
      }
    }
    newer_step_m_ = newer.length_m / std::max<std::size_t>(1, newer_points_.size());
    if (!older_walls_) return;
    older_points_ = evenly_sampled(older_walls_->points, params.points_max);
    older_step_m_ = older_walls_->length_m / std::max<std::size_t>(1, older_points_.size());
  }

  std::vector<LoopClosureAlternative> alternatives() {
    if (newer_points_.empty() || older_.empty()) return {};
    lever_arm_m_ = lever_arm_m(newer_points_);
    older_alone_.insert(flat(older_walls_->points), {}, 0.0);
    std::vector<RatedPlace> found;
    for (const Pose2& start : starts()) {
      const auto place = refine(start);
      if (place) found.push_back(*place);
    }
    credit_overlap(found);
    std::ranges::stable_sort(found, std::greater{}, [](const RatedPlace& place) -> double {
      return place.alternative.log_likelihood;
    });
    return distinct(found);
  }

  /// The contradiction with the newer map at T or, if it is more than `relevant`, after alignment
  /// close to T, whichever is smaller.
  [[nodiscard]] double contradiction_near(const Pose2& T, double relevant) const {
    if (newer_points_.empty() || older_.empty()) return 0.0;
    const double there = contradiction(T);
    if (there <= relevant) return there;
    const Pose2 aligned = align(newer_flat_, T, params_.refinement).T_odom_body;
    return same(aligned, T) ? std::min(there, contradiction(aligned)) : there;
  }

  /// Of the newer map in the older one, and the reverse.
  [[nodiscard]] WallComparison comparison(const Pose2& T) const {
    if (newer_points_.empty() || older_.empty()) return {};
    const auto [there, back] = agreements(T);
    const double reach_m = params_.agreement.wall_distance_max_m;
    WallComparison compared{
        newer_step_m_ * there.observed() + older_step_m_ * back.observed(),
        newer_step_m_ * there.contradicting + older_step_m_ * back.contradicting,
        distances_before_walls(newer_points_, T, older_, reach_m)};
    for (const double behind_m :
         distances_before_walls(older_points_, T.inverse(), newer_, reach_m))
      compared.before_m.push_back(-behind_m);
    return compared;
  }

 private:
  /// A place with the length of wall that both maps observed there.
  struct RatedPlace {
    LoopClosureAlternative alternative;
    double observed_m = 0.0;
  };

  /// Whether one of two places is the other one moved along the axis of a tunnel, which is open in
  /// both.
  static bool is_along_tunnel(const LoopClosureAlternative& a, const LoopClosureAlternative& b) {
    const Pose2 apart = between(a.T_older_newer, b.T_older_newer);
    if (std::abs(wrap_angle(apart.theta)) > kDistinctRad) return false;
    const Eigen::Vector2d direction = apart.translation().stableNormalized();
    return std::ranges::all_of(std::array{&a, &b}, [&](const LoopClosureAlternative* place) {
      const SymmetricEigen<2> axes =
          symmetric_eigen(Eigen::Matrix2d(place->information.topLeftCorner<2, 2>()));
      return axes.values.x() * kOpenRatio * kOpenRatio < axes.values.y() &&
             std::abs(direction.dot(axes.vectors.col(0))) > kAlongCosine;
    });
  }

  /// Smooth walls agree at each place along a tunnel, and add to the likelihood in proportion to
  /// what lies on each other there: the nearer two maps seem to be, the more. What would not be
  /// observed by both at a place, but is at another one along the tunnel, counts there as at the
  /// others on average.
  static void credit_overlap(std::vector<RatedPlace>& found) {
    const auto most = std::ranges::max_element(found, {}, &RatedPlace::observed_m);
    if (most == found.end()) return;
    std::vector<RatedPlace*> group;
    double log_likelihood = 0.0;
    double observed_m = 0.0;
    for (RatedPlace& place : found) {
      if (&place != &*most && !is_along_tunnel(most->alternative, place.alternative)) continue;
      group.push_back(&place);
      log_likelihood += place.alternative.log_likelihood;
      observed_m += place.observed_m;
    }
    const double most_m = most->observed_m;
    for (RatedPlace* place : group) {
      place->alternative.log_likelihood +=
          log_likelihood / std::max(1e-3, observed_m) * (most_m - place->observed_m);
    }
  }

  /// Of the newer map in the older one, and the reverse.
  [[nodiscard]] std::pair<WallAgreement, WallAgreement> agreements(const Pose2& T) const {
    const double z_m = ground_offset(newer_path_, T, older_path_).offset_m;
    return {agreement(newer_points_, T, older_, older_views_, params_.agreement, z_m),
            agreement(older_points_, T.inverse(), newer_, newer_views_, params_.agreement, -z_m)};
  }

  [[nodiscard]] double contradiction(const Pose2& T) const {
    const auto [there, back] = agreements(T);
    return excess(there) * newer_step_m_ / params_.independent_m +
           excess(back) * older_step_m_ / params_.independent_m;
  }

  /// Twice the log-likelihood ratio of the number of contradictions against that of maps of one
  /// place, if all points were independent.
  [[nodiscard]] double excess(const WallAgreement& found) const {
    const double usual = params_.agreement.contradiction;
    const double share = found.contradicting / std::max(1.0, static_cast<double>(found.observed()));
    if (share <= usual) return 0.0;
    const double rest = share < 1.0 ? (1.0 - share) * std::log((1.0 - share) / (1.0 - usual)) : 0.0;
    return 2.0 * found.observed() * (share * std::log(share / usual) + rest);
  }

  [[nodiscard]] std::vector<CorrelationPeak> peaks() const {
    const Eigen::Matrix2d plane = predicted_.covariance.topLeftCorner<2, 2>();
    const double sd_m = std::sqrt(std::max(0.0, symmetric_eigen(plane).values.y()));
    const double sd_rad = std::sqrt(std::max(0.0, predicted_.covariance(2, 2)));
    CorrelativeSearchParams search_params = params_.search;
    SearchWindow window;
    window.radius_m =
        std::clamp(params_.gate_sigmas * sd_m, 2.0 * search_params.cell_m, params_.radius_max_m);
    window.angle_rad = std::clamp(params_.gate_sigmas * sd_rad, 2.0 * search_params.angle_step_rad,
                                  std::numbers::pi);
    if (window.radius_m > kCoarseSearchM || window.angle_rad > kCoarseSearchRad) {
      search_params.cell_m *= 2.0;
      search_params.angle_step_rad *= 2.0;
      search_params.peak_separation_cells /= 2;
    }
    window.information = predicted_.covariance.inverse();
    // Includes the cells at the edge of a narrow gate.
    window.sigmas = params_.gate_sigmas + search_params.cell_m / std::max(sd_m, 1e-3);
    return search_correlation(newer_points_, older_, predicted_.T_older_newer, window,
                              params_.peaks, search_params);
  }

  /// The distinct poses after the peaks are aligned with few points: most peaks go through walls,
  /// or converge to the same pose.
  [[nodiscard]] std::vector<Pose2> starts() const {
    PointToLineParams coarse = params_.refinement;
    coarse.iterations_max = std::min(coarse.iterations_max, kFewIterations);
    std::vector<Pose2> distinct_poses;
    for (const auto& peak : peaks()) {
      if (!plausible(peak.T_odom_body, 0.8)) continue;
      const Pose2 T = align(few_flat_, peak.T_odom_body, coarse).T_odom_body;
      if (!plausible(T, 1.0)) continue;
      const bool duplicate = std::any_of(distinct_poses.begin(), distinct_poses.end(),
                                         [&](const Pose2& other) { return same(T, other); });
      if (!duplicate) distinct_poses.push_back(T);
    }
    return distinct_poses;
  }

  /// Whether enough of the few points lie on walls, and not in free space.
  [[nodiscard]] bool plausible(const Pose2& T, double strictness) const {
    const double z_m = ground_offset(newer_path_, T, older_path_).offset_m;
    const auto found = agreement(few_points_, T, older_, older_views_, params_.agreement, z_m);
    return found.observed() >= strictness * params_.observed_share_min * found.points &&
           found.near >= strictness * params_.on_wall_share_min * found.observed();
  }

  /// Without a prior: the graph already contains the prediction, which must not count twice.
  [[nodiscard]] PointToLineResult align(const std::vector<SurfacePoint>& points, const Pose2& start,
                                        const PointToLineParams& params) const {
    return align_to(older_, points, start, params);
  }

  [[nodiscard]] static PointToLineResult align_to(const SurfelMap& older,
                                                  const std::vector<SurfacePoint>& points,
                                                  const Pose2& start,
                                                  const PointToLineParams& params) {
    return match_point_to_line(points, older, start, {start, Eigen::Matrix3d::Zero()}, params);
  }

  /// Against the walls of the older map alone, if they suffice: its neighbours help to recognise
  /// the place, but lie where the displacements between them say.
  [[nodiscard]] FineMatch align_finely(const Pose2& start) const {
    PointToLineParams fine = params_.refinement;
    fine.scale_start_m = fine.scale_end_m;
    const PointToLineResult match = align(newer_flat_, start, fine);
    const PointToLineResult alone = align_to(older_alone_, newer_flat_, match.T_odom_body, fine);
    const bool suffices = alone.overlap >= params_.observed_share_min && alone.converged &&
                          same(alone.T_odom_body, match.T_odom_body);
    if (suffices) return {alone, Eigen::Matrix3d::Zero()};
    return {match, neighbours_covariance(match.T_odom_body)};
  }

  /// What the places of the neighbours, the least certain of which counts, add to the error of a
  /// match with their walls, in the newer frame.
  [[nodiscard]] Eigen::Matrix3d neighbours_covariance(const Pose2& T_older_newer) const {
    Eigen::Matrix3d largest = Eigen::Matrix3d::Zero();
    for (const auto& [T_older_walls, covariance] : placed_) {
      const Eigen::Matrix3d Ad = adjoint(between(T_older_newer, T_older_walls));
      const Eigen::Matrix3d there = Ad * covariance * Ad.transpose();
      if (there.trace() > largest.trace()) largest = there;
    }
    return largest;
  }

  [[nodiscard]] std::optional<RatedPlace> refine(const Pose2& start) const {
    const auto [match, neighbours_covariance] = align_finely(start);
    if (match.overlap < params_.observed_share_min) return std::nullopt;
    const double correlated = params_.correlated_points;
    const ConstrainedInformation constrained =
        split_degenerate(match.information / correlated, match.spurious / correlated, lever_arm_m_,
                         params_.degeneracy);
    const Eigen::Vector3d floor(params_.floor_m, params_.floor_m, params_.floor_rad);
    const Eigen::Matrix3d error_covariance =
        neighbours_covariance + floor.cwiseAbs2().asDiagonal().toDenseMatrix();
    RatedPlace place;
    LoopClosureAlternative& alternative = place.alternative;
    alternative.T_older_newer = slide(match.T_odom_body, constrained.degenerate);
    if (!in_gate(alternative.T_older_newer, constrained.covariance + error_covariance)) {
      return std::nullopt;
    }
    alternative.information = with_added_covariance(
        constrained.information,
        error_covariance + far_view_covariance(alternative.T_older_newer, match.rms_residual_m));
    return rate(place) ? std::optional(place) : std::nullopt;
  }

  /// The error of a match of two places that are far from each other, in the newer frame: along the
  /// line between the nearest points of their paths. Walls are rough as far as the residuals exceed
  /// the noise of the laser.
  [[nodiscard]] Eigen::Matrix3d far_view_covariance(const Pose2& T, double rms_residual_m) const {
    const Pose2 T_newer_older = T.inverse();
    if (older_walls_->path.empty() || newer_path_.empty()) return Eigen::Matrix3d::Zero();
    Eigen::Vector2d nearest = Eigen::Vector2d::Constant(std::numeric_limits<double>::max() / 4.0);
    for (const auto& [q, q_forward_m] : older_walls_->path) {
      const Eigen::Vector2d there = T_newer_older * Eigen::Vector2d(q.head<2>());
      for (const auto& [p, p_forward_m] : newer_path_) {
        const Eigen::Vector2d apart = there - p.head<2>();
        if (apart.squaredNorm() < nearest.squaredNorm()) nearest = apart;
      }
    }
    Eigen::Matrix3d covariance = Eigen::Matrix3d::Zero();
    const double noise_m = params_.refinement.residual_sd_min_m;
    const double roughness_m =
        std::sqrt(std::max(0.0, rms_residual_m * rms_residual_m - noise_m * noise_m));
    const Eigen::Vector2d root = params_.far_view_per_m2 * roughness_m * nearest.norm() * nearest;
    covariance.topLeftCorner<2, 2>() = root * root.transpose();
    return covariance;
  }

  /// Whether the pose, with this covariance, is in the gate of the prediction.
  [[nodiscard]] bool in_gate(const Pose2& T, const Eigen::Matrix3d& covariance) const {
    const Eigen::Vector3d off = between(predicted_.T_older_newer, T).vector();
    const Eigen::Matrix3d both = predicted_.covariance + covariance;
    return off.dot(both.inverse() * off) <= params_.gate_sigmas * params_.gate_sigmas;
  }

  /// Moves the pose to the prediction along the degenerate directions.
  [[nodiscard]] Pose2 slide(const Pose2& T,
                            const std::vector<UnconstrainedDirection>& directions) const {
    const Eigen::Vector3d scale(1.0, 1.0, lever_arm_m_);
    const Eigen::Vector3d off = between(T, predicted_.T_older_newer).vector().cwiseProduct(scale);
    Eigen::Vector3d back = Eigen::Vector3d::Zero();
    for (const auto& [v, information] : directions) back += v * v.dot(off);
    return T * Pose2::from_vector(back.cwiseQuotient(scale));
  }

  /// Sets the likelihood. False if the maps do not overlap or contradict each other.
  bool rate(RatedPlace& place) const {
    LoopClosureAlternative& alternative = place.alternative;
    const Pose2& T = alternative.T_older_newer;
    const auto [there, back] = agreements(T);
    if (there.observed() < params_.observed_share_min * there.points) return false;
    const int observed = there.observed() + back.observed();
    if (there.near + back.near < params_.on_wall_share_min * observed) return false;
    place.observed_m = newer_step_m_ * there.observed() + older_step_m_ * back.observed();
    // Points of one wall are not independent, and the two directions are nearly redundant.
    alternative.log_likelihood =
        0.5 / params_.independent_m *
        (newer_step_m_ * there.log_likelihood + older_step_m_ * back.log_likelihood);
    return alternative.log_likelihood >= params_.log_likelihood_min;
  }

  static bool same(const Pose2& T, const Pose2& other) {
    const Pose2 apart = between(other, T);
    return apart.translation().norm() < kDistinctM && std::abs(apart.theta) < kDistinctRad;
  }

  [[nodiscard]] static std::vector<LoopClosureAlternative> distinct(
      const std::vector<RatedPlace>& sorted) {
    std::vector<LoopClosureAlternative> distinct_poses;
    for (const RatedPlace& place : sorted) {
      const LoopClosureAlternative& alternative = place.alternative;
      const bool duplicate = std::any_of(
          distinct_poses.begin(), distinct_poses.end(),
          [&](const auto& other) { return same(alternative.T_older_newer, other.T_older_newer); });
      if (!duplicate) distinct_poses.push_back(alternative);
    }
    return distinct_poses;
  }

  struct Placed {
    Pose2 T_older_walls;
    Eigen::Matrix3d covariance;
  };

  const MapMatchingParams& params_;
  const RelativePose& predicted_;
  std::vector<Placed> placed_;
  std::vector<SurfacePoint> newer_points_;
  std::vector<SurfacePoint> few_points_;
  std::vector<SurfacePoint> newer_flat_;  ///< without heights, as is `few_flat_`
  std::vector<SurfacePoint> few_flat_;
  std::vector<TraversedPoint> newer_path_;
  SurfelMap newer_;
  const std::vector<LocalWalls::View>& newer_views_;
  std::shared_ptr<const LocalWalls> older_walls_;  ///< without its neighbours
  std::vector<SurfacePoint> older_points_;
  SurfelMap older_;  ///< with its neighbours
  SurfelMap older_alone_;
  std::vector<TraversedPoint> older_path_;
  std::vector<LocalWalls::View> older_views_;
  double newer_step_m_ = 0.0;  ///< length of wall per point
  double older_step_m_ = 0.0;
  double lever_arm_m_ = 1.0;
};

}  // namespace

Eigen::Matrix3d with_added_covariance(const Eigen::Matrix3d& information,
                                      const Eigen::Matrix3d& covariance) {
  const Eigen::Matrix3d sum = Eigen::Matrix3d::Identity() + covariance * information;
  const Eigen::Matrix3d result = information * sum.inverse();
  return 0.5 * (result + result.transpose());
}

double contradiction(const LocalWalls& newer, const std::vector<PlacedWalls>& older,
                     const Pose2& T_older_newer, const MapMatchingParams& params, double relevant) {
  const RelativePose there{T_older_newer, Eigen::Matrix3d::Identity()};
  return MapMatcher(newer, older, there, params).contradiction_near(T_older_newer, relevant);
}

WallComparison compare_walls(const LocalWalls& newer, const std::vector<PlacedWalls>& older,
                             const Pose2& T_older_newer, const MapMatchingParams& params) {
  const RelativePose there{T_older_newer, Eigen::Matrix3d::Identity()};
  return MapMatcher(newer, older, there, params).comparison(T_older_newer);
}

namespace {

/// Length of wall in space that the views observed free, at any height [m].
double length_in_free_space(const LocalWalls& walls, const Pose2& T_views_walls,
                            const std::vector<LocalWalls::View>& views, double margin_m) {
  constexpr double kAnyHeight = std::numeric_limits<double>::quiet_NaN();
  std::vector<bool> inside(walls.points.size(), false);
  for (const LocalWalls::View& view : views) {
    const Pose2 T_laser_walls =
        view.free_space.body_in_laser() * view.T_local_body.inverse() * T_views_walls;
    const Eigen::Matrix2d R = Eigen::Rotation2Dd(T_laser_walls.theta).toRotationMatrix();
    const Eigen::Vector2d t = T_laser_walls.translation();
    for (std::size_t i = 0; i < inside.size(); ++i) {
      if (inside[i]) continue;
      inside[i] = view.free_space.inside(R * walls.points[i].p + t, kAnyHeight, margin_m);
    }
  }
  const auto count = static_cast<double>(std::count(inside.begin(), inside.end(), true));
  return walls.length_m * count / std::max<std::size_t>(1, inside.size());
}

}  // namespace

double contradiction_bound(const LocalWalls& newer, const LocalWalls& older,
                           const Pose2& T_older_newer, const MapMatchingParams& params) {
  const double margin_m = params.agreement.margin_m;
  const double length_m =
      length_in_free_space(newer, T_older_newer, older.views, margin_m) +
      length_in_free_space(older, T_older_newer.inverse(), newer.views, margin_m);
  const double per_observation = -2.0 * std::log(params.agreement.contradiction);
  return per_observation * length_m / params.independent_m;
}

std::vector<LoopClosureAlternative> match_maps(const LocalWalls& newer,
                                               const std::vector<PlacedWalls>& older, int older_id,
                                               const RelativePose& predicted,
                                               const MapMatchingParams& params) {
  auto alternatives = MapMatcher(newer, older, predicted, params).alternatives();
  for (auto& alternative : alternatives) alternative.older_map = older_id;
  return alternatives;
}

}  // namespace adit

// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "procs/planning/passage/passage.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <iterator>
#include <numbers>

#include "procs/planning/passage/elastic_band.hpp"
#include "procs/planning/passage/guide.hpp"

namespace adit {
namespace {

constexpr double kStartM = 1.2;  // over which walls beside the robot may be as near as they are,
constexpr double kStartNearerM = 0.01;  // or nearer, until it has turned into the middle
constexpr double kShareOfRoom = 0.5;    // of the free width on each side, were the body centred,
constexpr double kUnevenMaxM = 0.08;    // up to which a path must keep it
constexpr int kSoftenings = 5;
constexpr double kStiffnessMax = 64.0;
constexpr double kSimilarM = 0.3;      // of progress; then the clearance counts
constexpr std::size_t kPointsMin = 5;  // of a band

/// The part of a band that the body can drive.
struct DrivablePart {
  std::vector<double> lengths_m;     ///< of the band up to each of its points
  std::vector<double> clearances_m;  ///< of the poses up to the first at which the body does not
                                     ///< fit or cannot steer
  std::size_t count = 0;             ///< of these poses, less the reserve at the end
};

/// The least clearance of a pose that has this one. Where there is room on the other side a path
/// that comes close to an edge is one to be approached from elsewhere: an edge is known less well
/// than the walls of a narrow tunnel, whose every cell has points.
double required_clearance_m(const WallDistance& walls, const Pose2& T_level_body,
                            double clearance_m, double clearance_min_m) {
  if (clearance_m >= kUnevenMaxM || clearance_m < clearance_min_m) return clearance_min_m;
  const WallDistance::Sides sides = walls.sides(T_level_body);
  const double centred_m = (sides.left_m + sides.right_m) / 2.0;
  return std::max(clearance_min_m, std::min(kShareOfRoom * centred_m, kUnevenMaxM));
}

/// Clearances of the poses up to the first at which the body does not fit or cannot steer. Beside
/// the robot walls may be as near as they are.
std::vector<double> clearances_m(const ElasticBand& band, const std::vector<double>& lengths_m,
                                 const WallDistance& walls, double curvature_max,
                                 double clearance_min_m) {
  std::vector<double> clearances_m;
  double start_m = 0.0;
  for (std::size_t i = 0; i < band.size(); ++i) {
    const Pose2 T_level_body = band.pose_at(i);
    const double clearance_m = walls.clearance_m(T_level_body);
    if (i == 0) start_m = clearance_m - kStartNearerM;
    const double least_m = required_clearance_m(walls, T_level_body, clearance_m, clearance_min_m);
    if (clearance_m < (lengths_m[i] < kStartM ? std::min(least_m, start_m) : least_m)) break;
    if (std::abs(band.curvature_1_m(i)) > curvature_max) break;
    clearances_m.push_back(clearance_m);
  }
  return clearances_m;
}

DrivablePart drivable_part(const ElasticBand& band, const WallDistance& walls, double curvature_max,
                           const PassageParams& params) {
  DrivablePart part;
  part.lengths_m = band.lengths_m();
  part.clearances_m =
      clearances_m(band, part.lengths_m, walls, curvature_max, params.clearance_min_m);
  part.count = part.clearances_m.size();
  if (part.count == band.size() || part.count == 0) return part;
  const double end_m = part.lengths_m[part.count - 1];
  while (part.count > 1 && end_m - part.lengths_m[part.count - 1] < params.end_reserve_m)
    --part.count;
  return part;
}

std::vector<PathPoint> points_of(const ElasticBand& band, const DrivablePart& part,
                                 const TerrainMap& terrain, bool reverse) {
  std::vector<PathPoint> points;
  for (std::size_t i = 0; i < part.count; ++i) {
    Pose2 T_level_body = band.pose_at(i);
    if (reverse) T_level_body = T_level_body * Pose2{0.0, 0.0, std::numbers::pi};
    // In reverse a turn to the left of the direction of travel is one to the right of the body.
    const double curvature_1_m = band.curvature_1_m(i) * (reverse ? -1.0 : 1.0);
    points.push_back({terrain.T_odom_level * T_level_body, i + 1 < part.count ? curvature_1_m : 0.0,
                      reverse, part.clearances_m[i], part.lengths_m[i]});
  }
  return points;
}

}  // namespace

std::optional<PlannedPath> plan_passage(const TerrainMap& terrain, const WallDistance& walls,
                                        const GoalField& goals, const Pose2& T_level_body,
                                        bool reverse, const Vehicle& vehicle,
                                        const PassageParams& params) {
  const Polyline guide =
      Guide(terrain, walls, goals, vehicle).to_most_progress(T_level_body.translation());
  if (guide.size() < kPointsMin) return std::nullopt;
  const Pose2 T_level_leading =
      reverse ? T_level_body * Pose2{0.0, 0.0, std::numbers::pi} : T_level_body;
  const double curvature_max = 1.0 / (vehicle.turning_radius_m * (1.0 + params.radius_reserve));
  std::optional<PlannedPath> best;
  ElasticBand band(guide, T_level_leading, walls);
  double stiffness = kStiffnessMax;
  double best_clearance_m = 0.0;
  for (int i = 0; i <= kSoftenings; ++i, stiffness /= 2.0) {
    band.relax(stiffness);
    const DrivablePart part = drivable_part(band, walls, curvature_max, params);
    if (part.count < kPointsMin) continue;
    const auto clearances = part.clearances_m.begin();
    const double least_m = *std::min_element(
        clearances, std::next(clearances, static_cast<std::ptrdiff_t>(part.count)));
    const double reached_m = goals.progress(band.pose_at(part.count - 1).translation());
    if (reached_m < goals.min_progress()) continue;
    if (best) {
      const double more_m = reached_m - best->reached_m;
      if (more_m < -kSimilarM || (more_m < kSimilarM && least_m <= best_clearance_m)) continue;
    }
    best_clearance_m = least_m;
    best.emplace();
    best->outcome = PlanOutcome::kFound;
    best->reason = "A path was found through a narrow passage.";
    best->points = points_of(band, part, terrain, reverse);
    best->reached_m = reached_m;
  }
  return best;
}

}  // namespace adit

// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "procs/guard/obstacle_check.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <numbers>

#include "common/types/body_outline.hpp"

namespace adit {
namespace {

constexpr double kNoContact = std::numeric_limits<double>::infinity();
constexpr double kTurn = 2.0 * std::numbers::pi;
constexpr double kStraight = 1e-5;  // curvature [1/m]: 0.02 mm beside a line after 2 m
constexpr double kTurnM = 0.15;     // along the arc, over which a close point comes nearer
constexpr double kNearerM = 0.002;  // less is an error of the steering
constexpr double kRounding = 1e-9;  // of a point on an edge [m, rad]
constexpr double kParallel = 1e-9;  // cosine of an edge that a point does not come nearer to

double clamped_curvature(const Vehicle& vehicle, double curvature_1_m) {
  const double max = 1.0 / vehicle.turning_radius_m;
  return std::clamp(curvature_1_m, -max, max);
}

Eigen::Vector2d centre_of_turn(const Vehicle& vehicle, double curvature_1_m) {
  const double x = vehicle.steering == "ackermann" ? -0.5 * vehicle.wheelbase_m : 0.0;
  const double radius = 1.0 / curvature_1_m;
  const double y = std::sqrt(std::max(0.0, radius * radius - x * x));
  return {x, std::copysign(y, curvature_1_m)};
}

}  // namespace

ArcSweep::ArcSweep(const Vehicle& vehicle, const ArcMotion& motion, double side_margin_m)
    : direction_(std::copysign(1.0, motion.speed_m_s)),
      curvature_1_m_(clamped_curvature(vehicle, motion.curvature_1_m)),
      straight_(std::abs(curvature_1_m_) < kStraight) {
  if (!straight_) centre_ = centre_of_turn(vehicle, curvature_1_m_);
  const ConvexPolygon outline = body_outline(vehicle);
  footprint_ = ringed(outline);
  widened_footprint_ = ringed(outline.widened(side_margin_m));
}

ArcSweep::Footprint ArcSweep::ringed(const ConvexPolygon& outline) const {
  double far_m = 0.0;
  for (const Eigen::Vector2d& corner : outline.corners())
    far_m = std::max(far_m, (corner - centre_).norm());
  return {outline, outline.distance_m(centre_), far_m};
}

double ArcSweep::distance_m(const Eigen::Vector2d& p_body) const {
  if (footprint_.outline.contains(p_body)) return p_body.x() * direction_ > 0.0 ? 0.0 : kNoContact;
  const bool is_close = widened_footprint_.outline.contains(p_body);
  if (is_close && turns_towards(p_body)) return 0.0;
  const Footprint& footprint = is_close ? footprint_ : widened_footprint_;
  return straight_ ? straight_distance_m(p_body, footprint) : distance_m(p_body, footprint);
}

/// Whether the arc brings a point beside the body nearer to its flank.
bool ArcSweep::turns_towards(const Eigen::Vector2d& p_body) const {
  if (straight_) return false;
  const double side = std::copysign(1.0, p_body.y());
  const double nearer_m = kTurnM * direction_ * curvature_1_m_ * (p_body.x() - centre_.x()) * side;
  return nearer_m > kNearerM;
}

double ArcSweep::reach_m(double distance_m) const {
  const double corner_distance_m =
      straight_ ? distance_m
                : distance_m * std::abs(curvature_1_m_) * widened_footprint_.radius_max_m;
  return widened_footprint_.outline.radius_m() + corner_distance_m;
}

double ArcSweep::straight_distance_m(const Eigen::Vector2d& p_body,
                                     const Footprint& footprint) const {
  const ConvexPolygon& outline = footprint.outline;
  if (p_body.y() < outline.low().y() || p_body.y() > outline.high().y()) return kNoContact;
  // The point passes the lines of all edges ahead before it is inside.
  double ahead_m = -kNoContact;
  for (const ConvexPolygon::Edge& edge : outline.edges()) {
    const double approach = direction_ * edge.normal.x();
    if (approach <= kParallel) continue;
    ahead_m = std::max(ahead_m, (edge.normal.dot(p_body) - edge.offset_m) / approach);
  }
  return ahead_m >= 0.0 ? ahead_m : kNoContact;
}

double ArcSweep::distance_m(const Eigen::Vector2d& p_body, const Footprint& footprint) const {
  const Eigen::Vector2d from = p_body - centre_;
  const double radius = from.norm();
  if (radius < footprint.radius_min_m || radius > footprint.radius_max_m) return kNoContact;
  const auto& corners = footprint.outline.corners();
  double turn = kNoContact;
  for (std::size_t i = 0; i < corners.size(); ++i) {
    const ConvexPolygon::Edge& edge = footprint.outline.edges()[i];
    const Eigen::Vector2d along(-edge.normal.y(), edge.normal.x());
    const double first_m = along.dot(corners[i] - centre_) - kRounding;
    const double last_m = along.dot(corners[(i + 1) % corners.size()] - centre_) + kRounding;
    const double beside_m = edge.offset_m - edge.normal.dot(centre_);
    const double across = std::sqrt(radius * radius - beside_m * beside_m);
    for (const double side : {across, -across}) {  // NaN: no intersection
      if (!(side >= first_m && side <= last_m)) continue;
      turn = std::min(turn, turn_rad(from, beside_m * edge.normal + side * along));
    }
  }
  return turn / std::abs(curvature_1_m_);
}

/// Angle from one point of the circle to another, in the direction in which points move: 0 to 2π.
double ArcSweep::turn_rad(const Eigen::Vector2d& from, const Eigen::Vector2d& to) const {
  const double left = std::atan2(from.x() * to.y() - from.y() * to.x(), from.dot(to));
  const double turn = direction_ * curvature_1_m_ > 0.0 ? -left : left;
  return turn < -kRounding ? turn + kTurn : std::max(0.0, turn);
}

double stopping_distance_m(const ObstacleParams& params, double speed_m_s, double age_s) {
  const double speed = std::abs(speed_m_s);
  return speed * (params.reaction_s + age_s) + 0.5 * speed * speed / params.braking_m_s2;
}

double side_margin_m(const ObstacleParams& params, double speed_m_s) {
  const double margin_m =
      std::max(params.side_margin_min_m, params.side_margin_s * std::abs(speed_m_s));
  return std::min(params.side_margin_m, margin_m);
}

double distance_to_obstacle_m(const LaserPoints& points, const ArcSweep& sweep, double within_m) {
  const double reach_m = sweep.reach_m(within_m);
  double nearest = kNoContact;
  double previous = kNoContact;  // of the neighbouring beam
  for (const Eigen::Vector2d& p_body : points.p_body) {
    const bool near = p_body.squaredNorm() <= reach_m * reach_m;  // false for NaN
    const double distance = near ? sweep.distance_m(p_body) : kNoContact;
    nearest = std::min(nearest, std::max(previous, distance));
    previous = distance;
  }
  return nearest < within_m ? nearest : kNoContact;
}

double distance_to_nearest_m(const std::vector<Eigen::Vector2d>& p_body, const ArcSweep& sweep,
                             double within_m) {
  double nearest = kNoContact;
  for (const Eigen::Vector2d& p : p_body) nearest = std::min(nearest, sweep.distance_m(p));
  return nearest < within_m ? nearest : kNoContact;
}

}  // namespace adit

// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "common/geometry/convex_polygon.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <tuple>
#include <utility>

#include "common/geometry/clipping.hpp"
#include "common/geometry/segment.hpp"

namespace adit {
namespace {

using Points = std::vector<Eigen::Vector2d>;

constexpr double kSameM = 1e-9;  // of points and lines

/// Andrew's monotone chain ("Another efficient algorithm for convex hulls in two dimensions",
/// 1979), counterclockwise, without points on edges.
Points convex_hull(Points points) {
  std::ranges::sort(points, [](const Eigen::Vector2d& a, const Eigen::Vector2d& b) {
    return std::tie(a.x(), a.y()) < std::tie(b.x(), b.y());
  });
  Points hull;
  const auto add = [&](const Eigen::Vector2d& p, std::size_t first) {
    while (hull.size() >= first + 2) {
      const Eigen::Vector2d& before = hull[hull.size() - 2];
      const Eigen::Vector2d step = p - before;
      if (cross(hull.back() - before, step) > kSameM * step.norm()) break;
      hull.pop_back();
    }
    hull.push_back(p);
  };
  for (const Eigen::Vector2d& p : points) add(p, 0);
  const std::size_t upper = hull.empty() ? 0 : hull.size() - 1;
  for (auto p = points.rbegin(); p != points.rend(); ++p) {
    if (p != points.rbegin()) add(*p, upper);
  }
  if (!hull.empty()) hull.pop_back();  // the first point again
  return hull.size() < 3 ? Points{} : hull;
}

}  // namespace

ConvexPolygon::ConvexPolygon(std::vector<Eigen::Vector2d> points)
    : corners_(convex_hull(std::move(points))) {
  if (corners_.empty()) return;
  low_ = high_ = corners_.front();
  for (std::size_t i = 0; i < corners_.size(); ++i) {
    const Eigen::Vector2d along = corners_[(i + 1) % corners_.size()] - corners_[i];
    const Eigen::Vector2d normal = Eigen::Vector2d(along.y(), -along.x()).normalized();
    edges_.push_back({normal, normal.dot(corners_[i])});
    low_ = low_.cwiseMin(corners_[i]);
    high_ = high_.cwiseMax(corners_[i]);
  }
}

ConvexPolygon ConvexPolygon::rectangle(const Eigen::Vector2d& middle, const Eigen::Vector2d& half) {
  return ConvexPolygon({middle - half,
                        middle + half,
                        {middle.x() - half.x(), middle.y() + half.y()},
                        {middle.x() + half.x(), middle.y() - half.y()}});
}

double ConvexPolygon::area_m2() const {
  double twice = 0.0;
  for (std::size_t i = 0; i < corners_.size(); ++i)
    twice += cross(corners_[i], corners_[(i + 1) % corners_.size()]);
  return 0.5 * twice;
}

double ConvexPolygon::radius_m() const {
  double radius_m = 0.0;
  for (const Eigen::Vector2d& corner : corners_) radius_m = std::max(radius_m, corner.norm());
  return radius_m;
}

bool ConvexPolygon::contains(const Eigen::Vector2d& p) const {
  return !empty() && std::ranges::all_of(edges_, [&](const Edge& edge) {
    return edge.normal.dot(p) <= edge.offset_m;
  });
}

double ConvexPolygon::distance_m(const Eigen::Vector2d& p) const {
  if (contains(p)) return 0.0;
  double nearest_m = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < corners_.size(); ++i) {
    const Segment2 edge{corners_[i], corners_[(i + 1) % corners_.size()]};
    nearest_m = std::min(nearest_m, (nearest_point(edge, p) - p).norm());
  }
  return nearest_m;
}

bool ConvexPolygon::meets_square(const Eigen::Vector2d& p, double half_m) const {
  const bool boxes_meet = !empty() && ((p.array() - half_m) < high_.array()).all() &&
                          ((p.array() + half_m) > low_.array()).all();
  return boxes_meet && std::ranges::all_of(edges_, [&](const Edge& edge) {
           return edge.normal.dot(p) - half_m * edge.normal.cwiseAbs().sum() < edge.offset_m;
         });
}

std::vector<Eigen::Vector2d> ConvexPolygon::boundary(double spacing_m) const {
  Points points;
  for (std::size_t i = 0; i < corners_.size(); ++i) {
    const Eigen::Vector2d along = corners_[(i + 1) % corners_.size()] - corners_[i];
    const int steps = static_cast<int>(std::ceil(along.norm() / spacing_m - kSameM));
    for (int k = 0; k < steps; ++k) points.emplace_back(corners_[i] + along * k / steps);
  }
  return points;
}

ConvexPolygon ConvexPolygon::grown(double by_m) const {
  if (empty()) return *this;
  // At a corner with the angle α, edges that are moved outwards meet |by| / sin(α / 2) from it. The
  // square contains them for any angle of more than a few degrees.
  const double reach_m = radius_m() + 100.0 * std::abs(by_m);
  Points corners = rectangle({0.0, 0.0}, {reach_m, reach_m}).corners();
  for (const Edge& edge : edges_) corners = clipped(corners, edge.normal, edge.offset_m + by_m);
  return ConvexPolygon(std::move(corners));
}

ConvexPolygon ConvexPolygon::widened(double by_m) const {
  Points points;
  for (const Eigen::Vector2d& corner : corners_) {
    points.emplace_back(corner.x(), corner.y() - by_m);
    points.emplace_back(corner.x(), corner.y() + by_m);
  }
  return ConvexPolygon(std::move(points));
}

ConvexPolygon ConvexPolygon::moved(const Pose2& T_a_b) const {
  Points points;
  for (const Eigen::Vector2d& corner : corners_) points.push_back(T_a_b * corner);
  return ConvexPolygon(std::move(points));
}

}  // namespace adit

// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "common/registration/surfel_map.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace adit {
namespace {

constexpr double kCosNormalMax = 0.5;  // 60°

struct Offset {
  int x;
  int y;
};
/// Offsets of the surrounding buckets, nearest first.
constexpr std::array<Offset, 8> kAround{
    {{-1, 0}, {1, 0}, {0, -1}, {0, 1}, {-1, -1}, {1, -1}, {-1, 1}, {1, 1}}};

int cell_of(double coordinate) {
  return static_cast<int>(std::floor(coordinate / SurfelMap::kBucket));
}

bool normals_agree(const Eigen::Vector2d& a, const Eigen::Vector2d& b) {
  const bool both_known = a.squaredNorm() > 0.5 && b.squaredNorm() > 0.5;
  return !both_known || a.dot(b) > kCosNormalMax;
}

}  // namespace

SurfelMap::SurfelMap(const SurfelMapParams& params, Buckets side)
    : params_(params),
      side_(static_cast<int>(side)),
      heads_(static_cast<std::size_t>(side_) * static_cast<std::size_t>(side_), -1) {}

void SurfelMap::clear() {
  surfels_.clear();
  std::fill(heads_.begin(), heads_.end(), -1);
}

void SurfelMap::link(int surfel) {
  auto& head = heads_[bucket(cell_of(surfels_[surfel].p.x()), cell_of(surfels_[surfel].p.y()))];
  surfels_[surfel].next = head;
  head = surfel;
}

void SurfelMap::insert(const std::vector<SurfacePoint>& points_body, const Pose2& T_odom_body,
                       double odometer) {
  const double c = std::cos(T_odom_body.theta);
  const double s = std::sin(T_odom_body.theta);
  const auto rotate = [&](const Eigen::Vector2d& v) {
    return Eigen::Vector2d(c * v.x() - s * v.y(), s * v.x() + c * v.y());
  };
  for (SurfacePoint point : points_body) {
    point.p = rotate(point.p) + T_odom_body.translation();
    point.normal = rotate(point.normal);
    merge(point, odometer);
  }
}

void SurfelMap::merge(const SurfacePoint& point, double odometer) {
  Surfel* found = nullptr;
  double best = params_.spacing_m * params_.spacing_m;
  const int ix0 = cell_of(point.p.x() - params_.spacing_m);
  const int ix1 = cell_of(point.p.x() + params_.spacing_m);
  const int iy0 = cell_of(point.p.y() - params_.spacing_m);
  const int iy1 = cell_of(point.p.y() + params_.spacing_m);
  for (int iy = iy0; iy <= iy1; ++iy) {
    for (int ix = ix0; ix <= ix1; ++ix) {
      for (int i = heads_[bucket(ix, iy)]; i >= 0; i = surfels_[i].next) {
        const double d2 = (surfels_[i].p - point.p).squaredNorm();
        if (d2 < best && normals_agree(surfels_[i].normal, point.normal)) {
          best = d2;
          found = &surfels_[i];
        }
      }
    }
  }
  if (found == nullptr) {
    surfels_.push_back({point.p, point.z_m, point.z_m, point.z_m, point.normal,
                        point.normal_variance, point.variance, odometer, -1});
    link(static_cast<int>(surfels_.size()) - 1);
    return;
  }
  found->last_observed = odometer;
  if (!point.has_normal()) return;
  // Means weighted by certainty. The weight of a new point has a lower bound, as a wall is not
  // exactly flat. The surfel moves only along its normal, so that it practically keeps its bucket,
  // which is sufficient for queries by distance.
  const auto share_of_new = [&](double old_variance, double new_variance) {
    return std::max(old_variance / (old_variance + new_variance), params_.share_min);
  };
  if (!found->has_normal()) {
    found->normal = point.normal;
    found->normal_variance = point.normal_variance;
  } else {
    const double share = share_of_new(found->normal_variance, point.normal_variance);
    found->normal = (found->normal + share * (point.normal - found->normal)).normalized();
    found->normal_variance = share * point.normal_variance;
  }
  const double share = share_of_new(found->variance, point.variance);
  found->p += share * found->normal.dot(point.p - found->p) * found->normal;
  found->z_m += share * (point.z_m - found->z_m);
  found->z_min_m = std::min(found->z_min_m, point.z_m);
  found->z_max_m = std::max(found->z_max_m, point.z_m);
  found->variance = share * point.variance;
}

void SurfelMap::remove_before(double odometer) {
  const auto old = [&](const Surfel& s) { return s.last_observed < odometer; };
  if (std::none_of(surfels_.begin(), surfels_.end(), old)) return;
  std::erase_if(surfels_, old);
  std::fill(heads_.begin(), heads_.end(), -1);
  for (int i = 0; i < static_cast<int>(surfels_.size()); ++i) link(i);
}

NearestSurfel SurfelMap::nearest(const Eigen::Vector2d& p, const Eigen::Vector2d& normal,
                                 double radius) const {
  const int cx = cell_of(p.x());
  const int cy = cell_of(p.y());
  const Surfel* found = nullptr;
  double best = std::numeric_limits<double>::infinity();
  double second = best;
  const auto visit = [&](int ix, int iy) {
    for (int i = heads_[bucket(ix, iy)]; i >= 0; i = surfels_[i].next) {
      const double d2 = (surfels_[i].p - p).squaredNorm();
      if (!(d2 < second) || !normals_agree(surfels_[i].normal, normal)) continue;
      second = std::max(d2, best);
      if (d2 < best) {
        best = d2;
        found = &surfels_[i];
      }
    }
  };
  // Squared distances to the neighbouring buckets: edge neighbours, and at the corners their sums.
  // In most cases the bucket of p holds two surfels nearer than all that the others can hold.
  const double left = p.x() - cx * kBucket;
  const double below = p.y() - cy * kBucket;
  const std::array<double, 3> x2{left * left, 0.0, (kBucket - left) * (kBucket - left)};
  const std::array<double, 3> y2{below * below, 0.0, (kBucket - below) * (kBucket - below)};
  visit(cx, cy);
  for (const auto [dx, dy] : kAround) {
    if (x2[dx + 1] + y2[dy + 1] < second) visit(cx + dx, cy + dy);
  }
  // The search is complete up to this distance, more than one bucket's side; the outer ring can
  // only hold farther surfels.
  double searched = kBucket + std::sqrt(std::min({x2[0], x2[2], y2[0], y2[2]}));
  if (best > kBucket * kBucket && radius > kBucket) {
    for (int k = -2; k <= 2; ++k) {
      visit(cx + k, cy - 2);
      visit(cx + k, cy + 2);
    }
    for (int k = -1; k <= 1; ++k) {
      visit(cx - 2, cy + k);
      visit(cx + 2, cy + k);
    }
    searched += kBucket;
  }
  const double distance = std::sqrt(best);
  if (distance < radius) return {found, 0.5 * (std::min(std::sqrt(second), searched) - distance)};
  return {nullptr, std::min(distance, searched) - radius};
}

}  // namespace adit

// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "tools/sample_mine/parallel_mine.hpp"

#include <algorithm>
#include <iterator>

#include "tools/sample_mine/rock.hpp"
#include "tools/sample_mine/wall_contour.hpp"

namespace adit {
namespace {

using Point = Eigen::Vector2d;

constexpr double kApart = 12.0;

const Point kSouthWest{0, 0};
const Point kSouthEast{70, 0};
const Point kNorthEast{70, kApart};
const Point kNorthWest{0, kApart};
const Point kLoop[] = {{-12, kApart}, {-24, 24},  {-20, 46},  {40, 52},   {110, 46},
                       {180, 54},     {214, 40},  {210, -10}, {190, -44}, {120, -38},
                       {50, -46},     {-10, -40}, {-26, -24}, {-24, -10}, {-12, 0}};

std::vector<Working> workings() {
  constexpr double kHalfWidth = 1.6;
  std::vector<Working> plan = {{kSouthWest, kSouthEast, kHalfWidth},
                               {kSouthEast, kNorthEast, kHalfWidth},
                               {kNorthEast, kNorthWest, kHalfWidth},
                               {kSouthEast, {84, -3}, 1.5}};
  Point from = kNorthWest;
  for (const Point& to : kLoop) {
    plan.push_back({from, to, kHalfWidth});
    from = to;
  }
  plan.push_back({from, kSouthWest, kHalfWidth});
  return plan;
}

/// The north drift has the walls of the south drift, but for its east end.
Point pattern(const Point& p) {
  constexpr double kFrom = 60.0;
  constexpr double kTo = 66.0;
  const bool north = p.y() > kApart / 2.0 && p.y() < 1.5 * kApart && p.x() > -10.0;
  if (!north) return p;
  const double share = std::clamp((kTo - p.x()) / (kTo - kFrom), 0.0, 1.0);
  return p - Point(0.0, share * kApart);
}

}  // namespace

SyntheticWorld parallel_mine(std::uint64_t seed) {
  return SyntheticWorld(
      zero_contour(Rock(workings(), {}, seed, pattern), {-32.0, -54.0}, {222.0, 62.0}, 0.2));
}

std::vector<Eigen::Vector2d> parallel_mine_route() {
  std::vector<Point> route = {{-8, 0}, kSouthEast, kNorthEast, kNorthWest};
  route.insert(route.end(), std::begin(kLoop), std::end(kLoop));
  route.insert(route.end(), {kSouthEast, kNorthEast, {30, kApart}});
  return route;
}

OdometryModel parallel_mine_odometry() {
  return {.distance_scale = 1.0,
          .turn_scale = 1.0,
          .drift_rad_per_m = -0.00016,
          .distance_noise_m_per_sqrt_m = 0.005,
          .turn_noise_rad_per_sqrt_m = 0.0002,
          .turn_noise_rad_per_sqrt_rad = 0.0005};
}

}  // namespace adit

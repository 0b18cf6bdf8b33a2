// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "tools/sample_mine/mine_worlds.hpp"

#include <algorithm>
#include <random>

#include "tools/sample_mine/rock.hpp"
#include "tools/sample_mine/wall_contour.hpp"

namespace adit {
namespace {

using Point = Eigen::Vector2d;

const Point kPortal{-6.0, 0.0};
const Point kRing[] = {{35, 0},  {48, -4}, {78, -6}, {100, 8}, {104, 34},
                       {86, 52}, {56, 50}, {36, 40}, {30, 18}};
const Point kRoom{68, 21};

std::vector<Working> workings() {
  std::vector<Working> plan = {
      {kPortal, kRing[0], 1.4},  {kRing[2], kRoom, 1.6},    {kRoom, kRing[6], 1.6},
      {{62, 21}, {74, 21}, 7.5}, {kRing[3], {124, 1}, 1.5},  // dead ends
      {kRing[5], {93, 70}, 1.4}, {kRing[7], {17, 49}, 1.7}, {{104, 22}, {116, 24}, 1.3}};
  const std::size_t corners = std::size(kRing);
  for (std::size_t i = 0; i < corners; ++i) {
    const double half_width_m = 1.6 + 0.25 * static_cast<double>(i % 3);
    plan.push_back({kRing[i], kRing[(i + 1) % corners], half_width_m});
  }
  return plan;
}

std::vector<Pillar> pillars(std::uint64_t seed) {
  std::mt19937_64 random(seed);
  std::uniform_real_distribution<double> shift(-0.4, 0.4);
  std::vector<Pillar> result;
  for (const Point& centre :
       {Point(62, 25), Point(58.5, 20.5), Point(63, 17.5), Point(64.5, 21.5), Point(70, 25.5),
        Point(74.5, 16.5), Point(73, 20.8), Point(76.5, 23)}) {
    const double dx = shift(random);
    const double dy = shift(random);
    result.push_back({centre + Point(dx, dy), 1.1 + 0.5 * shift(random)});
  }
  return result;
}

}  // namespace

SyntheticWorld straight_tunnel(double length_m, double width_m) {
  const double x = length_m / 2.0;
  const double y = width_m / 2.0;
  return SyntheticWorld({{{-x, y}, {x, y}}, {{-x, -y}, {x, -y}}});
}

SyntheticWorld sample_mine(std::uint64_t seed) {
  const Rock rock(workings(), pillars(seed), seed);
  std::vector<Segment> walls = zero_contour(rock, {-10.0, -16.0}, {132.0, 80.0}, 0.2);
  // The adit ends in daylight.
  std::erase_if(walls, [](const Segment& wall) { return std::min(wall.a.x(), wall.b.x()) < -3.0; });
  return SyntheticWorld(std::move(walls));
}

std::vector<Eigen::Vector2d> sample_mine_route() {
  std::vector<Point> route = {{0.0, 0.0}};
  route.insert(route.end(), std::begin(kRing), std::end(kRing));  // once around
  route.insert(route.end(), {kRing[0], kRing[1], kRing[2]});      // again, and across
  route.insert(route.end(), {{70, 15}, {68.5, 21}, {65.5, 27.5}, kRing[6], kRing[7], kRing[8]});
  route.insert(route.end(), {{34.8, 0.8}, {33, 0}, {0.0, 0.0}});
  return route;
}

}  // namespace adit

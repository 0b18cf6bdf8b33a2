// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "tools/sample_mine/rock.hpp"

#include <algorithm>
#include <utility>

namespace adit {
namespace {

double distance_to(const Eigen::Vector2d& p, const Working& working) {
  const Eigen::Vector2d along = working.to - working.from;
  const double share = std::clamp((p - working.from).dot(along) / along.squaredNorm(), 0.0, 1.0);
  return (p - working.from - share * along).norm();
}

}  // namespace

Rock::Rock(std::vector<Working> workings, std::vector<Pillar> pillars, std::uint64_t seed,
           Pattern pattern)
    : workings_(std::move(workings)),
      pillars_(std::move(pillars)),
      roughness_(seed),
      pattern_(std::move(pattern)) {}

double Rock::operator()(const Eigen::Vector2d& p) const {
  double depth = 1e9;
  for (const Working& w : workings_) depth = std::min(depth, distance_to(p, w) - w.half_width_m);
  for (const Pillar& pillar : pillars_) {
    depth = std::max(depth, pillar.radius_m - (p - pillar.centre).norm());
  }
  return roughness_(depth, pattern_(p));
}

}  // namespace adit

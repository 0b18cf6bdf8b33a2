// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "sim/world/random/wandering_line.hpp"

#include <algorithm>
#include <cmath>

#include "sim/world/random/topologies.hpp"

namespace adit {
namespace {

constexpr double kBend = 0.15;  // of a piece against the direction of the whole, at most [rad]

}  // namespace

std::vector<Eigen::Vector2d> wandering_line(const Eigen::Vector2d& from, double heading_rad,
                                            double length_m, Dice& dice) {
  std::vector<Eigen::Vector2d> line{from};
  for (double left_m = length_m; left_m > 0.0;) {
    double piece_m = std::min(left_m, dice.between(15.0, 35.0));
    if (left_m - piece_m < 5.0) piece_m = left_m;  // no tiny piece at the end
    const double heading = heading_rad + dice.between(-kBend, kBend);
    line.emplace_back(line.back() +
                      piece_m * Eigen::Vector2d(std::cos(heading), std::sin(heading)));
    left_m -= piece_m;
  }
  return line;
}

DriftDescription drift_along(const std::string& name, const std::vector<Eigen::Vector2d>& line,
                             double width_m) {
  DriftDescription drift{.name = name, .points_m = {}, .width_m = width_m};
  for (const Eigen::Vector2d& point : line) {
    drift.points_m.push_back(point.x());
    drift.points_m.push_back(point.y());
  }
  return drift;
}

DriftDescription main_drift(double length_m, Dice& dice) {
  const Eigen::Vector2d sound_end(std::min(kSoundLength, length_m), 0.0);
  std::vector<Eigen::Vector2d> line{Eigen::Vector2d(0.0, 0.0)};
  const auto rest = wandering_line(sound_end, 0.0, length_m - sound_end.x(), dice);
  line.insert(line.end(), rest.begin(), rest.end());
  DriftDescription drift = drift_along("main", line, dice.between(3.0, 5.0));
  drift.entrance = true;
  return drift;
}

}  // namespace adit

// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "procs/planning/passage/body_lean.hpp"

#include <cmath>
#include <cstddef>
#include <limits>

namespace adit {
namespace {

constexpr float kNone = std::numeric_limits<float>::quiet_NaN();
constexpr double kNoiseM = 0.05;    // of the difference of two wheels: pebbles, seams between scans
constexpr int kContactSamples = 4;  // of the contact of a wheel to each side of its middle
constexpr double kContactM = 0.1;   // contact of a wheel, before and behind its axle

/// Difference of the heights of two wheels; 0 where unknown or within the noise.
double difference_m(double a_m, double b_m) {
  const double difference = a_m - b_m;
  return std::abs(difference) > kNoiseM ? difference : 0.0;  // false for NaN
}

}  // namespace

BodyLean::BodyLean(const TerrainMap& terrain, const Vehicle& vehicle)
    : vehicle_(vehicle),
      p_level_corner_(terrain.p_level_corner),
      cell_m_(terrain.cell_m),
      tops_m_(terrain.cells.box(), kNone),
      trend_(terrain.ground_m(), terrain.cell_m) {
  for (std::size_t i = 0; i < terrain.cells.size(); ++i) {
    const TerrainCell& cell = terrain.cells[i];
    const bool is_climbed = cell.ground == Ground::kObserved &&
                            static_cast<double>(cell.coefficient_m) <= vehicle.step_max_m;
    if (is_climbed) tops_m_[i] = cell.low_m + cell.coefficient_m;
  }
}

Eigen::Vector2d BodyLean::top_m(const Pose2& T_level_body) const {
  const double x_m = vehicle_.wheelbase_m / 2.0;
  const double y_m = vehicle_.track_m / 2.0;
  const double front_left = wheel_height_m(T_level_body, x_m, y_m);
  const double front_right = wheel_height_m(T_level_body, x_m, -y_m);
  const double rear_left = wheel_height_m(T_level_body, -x_m, y_m);
  const double rear_right = wheel_height_m(T_level_body, -x_m, -y_m);
  const double rise_ahead =
      0.5 * (difference_m(front_left, rear_left) + difference_m(front_right, rear_right));
  const double rise_left =
      0.5 * (difference_m(front_left, front_right) + difference_m(rear_left, rear_right));
  return -vehicle_.height_m *
         Eigen::Vector2d(rise_ahead / vehicle_.wheelbase_m, rise_left / vehicle_.track_m);
}

/// The highest ground under a wheel above the trend of the ground around the body; NaN without any.
double BodyLean::wheel_height_m(const Pose2& T_level_body, double x_m, double y_m) const {
  const Eigen::Vector2i at = cell_of(T_level_body.translation() - p_level_corner_, cell_m_);
  if (!tops_m_.contains(at)) return kNone;
  const Eigen::Vector2d grade = trend_.rise_m(at.x(), at.y()).cast<double>() / cell_m_;
  const double rise_m =
      grade.dot(T_level_body * Eigen::Vector2d(x_m, y_m) - T_level_body.translation());
  double highest_m = kNone;
  for (int i = -kContactSamples; i <= kContactSamples; ++i) {
    for (int j = -kContactSamples; j <= kContactSamples; ++j) {
      const Eigen::Vector2d p_body(x_m + kContactM * i / kContactSamples,
                                   y_m + 0.5 * vehicle_.wheel_width_m * j / kContactSamples);
      const Eigen::Vector2i cell = cell_of(T_level_body * p_body - p_level_corner_, cell_m_);
      if (!tops_m_.contains(cell)) continue;
      highest_m = std::fmax(highest_m, static_cast<double>(tops_m_.at(cell)));
    }
  }
  return highest_m - rise_m;
}

}  // namespace adit

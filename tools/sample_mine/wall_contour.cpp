// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "tools/sample_mine/wall_contour.hpp"

#include <array>
#include <cmath>

namespace adit {
namespace {

struct Sample {
  Eigen::Vector2d p;
  double value;
};

/// Where the function passes zero between two corners, if it does.
void add_crossing(const Sample& a, const Sample& b, std::vector<Eigen::Vector2d>& crossings) {
  if ((a.value < 0.0) == (b.value < 0.0)) return;
  crossings.emplace_back(a.p + a.value / (a.value - b.value) * (b.p - a.p));
}

/// Corners in order around the square. Two opposite corners of each sign give four crossings, which
/// are joined in order: either way of joining them is a contour.
void add_square(const std::array<Sample, 4>& corners, std::vector<Segment>& contour) {
  std::vector<Eigen::Vector2d> crossings;
  for (std::size_t i = 0; i < 4; ++i) add_crossing(corners[i], corners[(i + 1) % 4], crossings);
  for (std::size_t i = 0; i + 1 < crossings.size(); i += 2) {
    contour.push_back({crossings[i], crossings[i + 1]});
  }
}

}  // namespace

std::vector<Segment> zero_contour(const std::function<double(const Eigen::Vector2d&)>& function,
                                  const Eigen::Vector2d& low, const Eigen::Vector2d& high,
                                  double step_m) {
  const auto columns = static_cast<int>(std::ceil((high.x() - low.x()) / step_m));
  const auto rows = static_cast<int>(std::ceil((high.y() - low.y()) / step_m));
  const auto sample_row = [&](int row) {
    std::vector<Sample> samples;
    for (int column = 0; column <= columns; ++column) {
      const Eigen::Vector2d p = low + step_m * Eigen::Vector2d(column, row);
      samples.push_back({p, function(p)});
    }
    return samples;
  };
  std::vector<Segment> contour;
  std::vector<Sample> below = sample_row(0);
  for (int row = 1; row <= rows; ++row) {
    std::vector<Sample> above = sample_row(row);
    for (std::size_t i = 0; i + 1 < above.size(); ++i) {
      add_square({below[i], below[i + 1], above[i + 1], above[i]}, contour);
    }
    below = std::move(above);
  }
  return contour;
}

}  // namespace adit

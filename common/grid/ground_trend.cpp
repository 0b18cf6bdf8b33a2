// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "common/grid/ground_trend.hpp"

#include <algorithm>
#include <cmath>
#include <optional>
#include <vector>

namespace adit {
namespace {

constexpr double kNodeM = 1.0;         // between nodes, and reach of the heights of one
constexpr float kPairGradeMax = 0.6F;  // steeper pairs are walls; above kGradeMax for the noise
constexpr int kPairStride = 2;         // of the cells at which pairs begin
constexpr std::size_t kPairsMin = 20;
constexpr double kQuantile = 0.35;  // and 1 − kQuantile
constexpr int kFillPasses = 2;      // to nodes without heights, in nodes

using Node = std::optional<Eigen::Vector2f>;

/// Grades between the pairs of cells `lag` apart in a box.
void collect_grades(const Grid2<float>& heights_m, const CellBox& box, const Eigen::Vector2i& lag,
                    float pair_m, std::vector<float>& grades) {
  grades.clear();
  const std::ptrdiff_t ahead = lag.x() + std::ptrdiff_t{lag.y()} * heights_m.columns();
  for (int row = box.from.y(); row < box.to.y() - lag.y(); row += kPairStride) {
    const float* heights = &heights_m.at({0, row});
    for (int column = box.from.x(); column < box.to.x() - lag.x(); column += kPairStride) {
      const float grade = (heights[column + ahead] - heights[column]) / pair_m;
      if (std::abs(grade) <= kPairGradeMax) grades.push_back(grade);  // false for NaN
    }
  }
}

std::optional<float> robust_grade(std::vector<float>& grades) {
  if (grades.size() < kPairsMin) return std::nullopt;
  const auto at = [&](double share) {
    const auto i = grades.begin() + std::lround(share * static_cast<double>(grades.size() - 1));
    std::nth_element(grades.begin(), i, grades.end());
    return *i;
  };
  return std::clamp(0.0F, at(kQuantile), at(1.0 - kQuantile));
}

/// Gives nodes without a grade the mean of those around them.
void fill_nodes(Grid2<Node>& nodes) {
  for (int pass = 0; pass < kFillPasses; ++pass) {
    const Grid2<Node> before = nodes;
    for (std::size_t i = 0; i < nodes.size(); ++i) {
      if (before[i]) continue;
      Eigen::Vector2f sum = Eigen::Vector2f::Zero();
      float known = 0.0F;
      for (int dy = -1; dy <= 1; ++dy) {
        for (int dx = -1; dx <= 1; ++dx) {
          const Node node = before.get(before.cell(i) + Eigen::Vector2i(dx, dy));
          if (!node) continue;
          sum += *node;
          known += 1.0F;
        }
      }
      if (known > 0.0F) nodes[i] = sum / known;
    }
  }
}

}  // namespace

GroundTrend::GroundTrend(const Grid2<float>& heights_m, double cell_m)
    : rise_m_(heights_m.box(), Eigen::Vector2f::Zero()) {
  const int spacing = std::max(static_cast<int>(std::lround(kNodeM / cell_m)), 2);
  const int lag = spacing / 2;
  const auto pair_m = static_cast<float>(lag * cell_m);
  Grid2<Node> nodes(heights_m.columns() / spacing + 2, heights_m.rows() / spacing + 2);
  std::vector<float> grades;
  for (std::size_t i = 0; i < nodes.size(); ++i) {
    const Eigen::Vector2i middle = spacing * nodes.cell(i);
    const CellBox box{(middle.array() - spacing).max(0),
                      (middle.array() + spacing + 1).min(heights_m.box().to.array())};
    collect_grades(heights_m, box, {lag, 0}, pair_m, grades);
    const auto along_x = robust_grade(grades);
    collect_grades(heights_m, box, {0, lag}, pair_m, grades);
    const auto along_y = robust_grade(grades);
    if (!along_x && !along_y) continue;
    const Eigen::Vector2f grade(along_x.value_or(0.0F), along_y.value_or(0.0F));
    nodes[i] = grade * std::min(1.0F, kGradeMax / std::max(grade.norm(), kGradeMax));
  }
  fill_nodes(nodes);
  const auto cell = static_cast<float>(cell_m);
  for (int row = 0; row < rise_m_.rows(); ++row) {
    const auto v = static_cast<float>(row % spacing) / static_cast<float>(spacing);
    for (int column = 0; column < rise_m_.columns(); ++column) {
      const auto u = static_cast<float>(column % spacing) / static_cast<float>(spacing);
      const Eigen::Vector2i at(column / spacing, row / spacing);
      const auto node = [&](int dx, int dy) {
        return nodes.at(at + Eigen::Vector2i(dx, dy)).value_or(Eigen::Vector2f::Zero());
      };
      const Eigen::Vector2f below = (1.0F - u) * node(0, 0) + u * node(1, 0);
      const Eigen::Vector2f above = (1.0F - u) * node(0, 1) + u * node(1, 1);
      rise_m_.at({column, row}) = cell * ((1.0F - v) * below + v * above);
    }
  }
}

}  // namespace adit

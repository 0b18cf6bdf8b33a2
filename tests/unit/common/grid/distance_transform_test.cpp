// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "common/grid/distance_transform.hpp"

#include <algorithm>
#include <limits>
#include <random>

#include <gtest/gtest.h>

namespace adit {
namespace {

const CellBox kBox{{-5, 3}, {18, 20}};  // 23 × 17 cells
constexpr double kCellM = 0.1;

TEST(DistanceTransform, IsTheDistanceToTheNearestMarkedCell) {
  std::mt19937 engine(3);
  std::bernoulli_distribution marked(0.02);
  for (int round = 0; round < 50; ++round) {
    Grid2<std::uint8_t> cells(kBox);
    for (auto& cell : cells) cell = marked(engine) ? 1 : 0;
    const Grid2<float> distances = distance_transform(cells, kCellM);
    EXPECT_EQ(distances.box(), kBox);
    for (std::size_t i = 0; i < cells.size(); ++i) {
      double nearest = std::numeric_limits<double>::infinity();
      for (std::size_t j = 0; j < cells.size(); ++j) {
        if (cells[j] == 0) continue;
        nearest = std::min(nearest, (cells.cell(i) - cells.cell(j)).cast<double>().norm());
      }
      EXPECT_FLOAT_EQ(distances[i], static_cast<float>(kCellM * nearest));
    }
  }
}

}  // namespace
}  // namespace adit

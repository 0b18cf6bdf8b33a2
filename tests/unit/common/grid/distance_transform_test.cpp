// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "common/grid/distance_transform.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>

#include <gtest/gtest.h>

namespace adit {
namespace {

constexpr int kColumns = 23;
constexpr int kRows = 17;
constexpr double kCellM = 0.1;

TEST(DistanceTransform, IsTheDistanceToTheNearestMarkedCell) {
  std::mt19937 engine(3);
  std::bernoulli_distribution marked(0.02);
  for (int round = 0; round < 50; ++round) {
    std::vector<std::uint8_t> cells(kColumns * kRows);
    for (auto& cell : cells) cell = marked(engine) ? 1 : 0;
    const auto distances = distance_transform(cells, kColumns, kCellM);
    for (int i = 0; i < kColumns * kRows; ++i) {
      double nearest = std::numeric_limits<double>::infinity();
      for (int j = 0; j < kColumns * kRows; ++j) {
        if (cells[static_cast<std::size_t>(j)] == 0) continue;
        nearest =
            std::min(nearest, std::hypot(i % kColumns - j % kColumns, i / kColumns - j / kColumns));
      }
      EXPECT_FLOAT_EQ(distances[static_cast<std::size_t>(i)], static_cast<float>(kCellM * nearest));
    }
  }
}

}  // namespace
}  // namespace adit

// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "common/grid/distance_transform.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <vector>

namespace adit {
namespace {

constexpr double kInfinite = std::numeric_limits<double>::infinity();

/// The lower envelope of parabolas over a line of cells.
class Envelope {
 public:
  explicit Envelope(std::size_t n) : place_(n), from_(n + 1), value_(n) {}

  /// Replaces each of `n` values, `stride` apart, by the least of value + distance² over all.
  void transform(double* values, std::size_t n, std::size_t stride) {
    std::size_t parabolas = 0;
    for (std::size_t q = 0; q < n; ++q) {
      value_[q] = values[q * stride];
      if (value_[q] < kInfinite) parabolas = with(q, parabolas);
    }
    if (parabolas == 0) return;
    from_[parabolas] = kInfinite;
    for (std::size_t q = 0, k = 0; q < n; ++q) {
      while (from_[k + 1] < static_cast<double>(q)) ++k;
      const double away = static_cast<double>(q) - static_cast<double>(place_[k]);
      values[q * stride] = away * away + value_[place_[k]];
    }
  }

 private:
  /// Adds that of cell q to the envelope of the first `parabolas`; how many there are then.
  std::size_t with(std::size_t q, std::size_t parabolas) {
    double from = -kInfinite;
    while (parabolas > 0) {
      from = meeting(place_[parabolas - 1], q);
      if (from > from_[parabolas - 1]) break;
      --parabolas;
      from = -kInfinite;
    }
    place_[parabolas] = q;
    from_[parabolas] = from;
    return parabolas + 1;
  }

  [[nodiscard]] double meeting(std::size_t p, std::size_t q) const {
    const auto a = static_cast<double>(p);
    const auto b = static_cast<double>(q);
    return (value_[q] + b * b - value_[p] - a * a) / (2.0 * (b - a));
  }

  std::vector<std::size_t> place_;
  std::vector<double> from_;
  std::vector<double> value_;
};

}  // namespace

Grid2<float> distance_transform(const Grid2<std::uint8_t>& marked, double cell_m) {
  const auto width = static_cast<std::size_t>(marked.columns());
  const auto height = static_cast<std::size_t>(marked.rows());
  std::vector<double> squares(marked.size());
  for (std::size_t i = 0; i < marked.size(); ++i) squares[i] = marked[i] != 0 ? 0.0 : kInfinite;
  Envelope envelope(std::max(width, height));
  for (std::size_t row = 0; row < height; ++row) {
    envelope.transform(squares.data() + row * width, width, 1);
  }
  for (std::size_t column = 0; column < width; ++column) {
    envelope.transform(squares.data() + column, height, width);
  }
  Grid2<float> distances(marked.box());
  for (std::size_t i = 0; i < squares.size(); ++i) {
    distances[i] = static_cast<float>(cell_m * std::sqrt(squares[i]));
  }
  return distances;
}

}  // namespace adit

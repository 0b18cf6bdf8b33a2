// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "common/registration/correlative_search.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>

namespace adit {
namespace {

constexpr int kLevels = 3;  // blocks of 1, 2 and 4 shifts each way
constexpr int kRow = 8;     // blocks side by side that are bounded together

/// Closeness to the reference in [0, 255] around the search centre, for each fine cell on several
/// levels: the maximum over the cell and the 2^level - 1 next each way, which is the tightest bound
/// for all shifts of less than that. Large enough that no point at any shift of the search falls
/// outside, so that sums need no checks.
class LookupGrid {
 public:
  LookupGrid(double cell, double half_width, const Eigen::Vector2d& centre) : cell_(cell) {
    constexpr int kCoarsest = 1 << (kLevels - 1);
    side_ = (static_cast<int>(std::ceil(2.0 * half_width / (cell * kCoarsest))) + 2) * kCoarsest;
    origin_ = centre - Eigen::Vector2d::Constant(0.5 * side_ * cell);
    for (auto& values : values_) values.assign(static_cast<std::size_t>(side_) * side_ + kRow, 0);
  }

  [[nodiscard]] int index_x(double x) const { return static_cast<int>((x - origin_.x()) / cell_); }
  [[nodiscard]] int index_y(double y) const { return static_cast<int>((y - origin_.y()) / cell_); }

  /// Of a level, moved by so many blocks; kRow values may be read from any place.
  [[nodiscard]] const std::uint8_t* values(int level, int blocks_x, int blocks_y) const {
    return values_[level].data() + static_cast<std::ptrdiff_t>(blocks_y) * side(level) + blocks_x;
  }

  /// Where the value of a fine cell lies. What differs by a multiple of 2^level fine cells lies
  /// side by side: one step in x is 1, one in y is `side`.
  [[nodiscard]] int place(int level, int x, int y) const {
    const int phases = 1 << level;
    const int phase = ((y & (phases - 1)) << level) + (x & (phases - 1));
    return (phase * side(level) + (y >> level)) * side(level) + (x >> level);
  }
  [[nodiscard]] int side(int level) const { return side_ >> level; }

  void stamp(const Eigen::Vector2d& p) {
    const int cx = index_x(p.x());
    const int cy = index_y(p.y());
    if (cx < 1 || cy < 1 || cx >= side_ - 1 || cy >= side_ - 1) return;
    if (values_[0][cy * side_ + cx] == kCloseness[0]) return;  // another point of this cell did it
    for (int level = 0; level < kLevels; ++level) stamp(level, cx, cy);
  }

 private:
  static constexpr std::array<std::uint8_t, 3> kCloseness{255, 140, 80};  // same, beside, corner

  /// All cells whose maximum takes in the fine cell (cx, cy) or one beside it.
  void stamp(int level, int cx, int cy) {
    const int seen = 1 << level;
    const auto off = [&](int u, int c) { return u > c || u + seen <= c ? 1 : 0; };
    for (int v = std::max(cy - seen, 0); v <= cy + 1; ++v) {
      for (int u = std::max(cx - seen, 0); u <= cx + 1; ++u) {
        auto& value = values_[level][place(level, u, v)];
        value = std::max(value, kCloseness[off(u, cx) + off(v, cy)]);
      }
    }
  }

  double cell_;
  int side_ = 0;
  Eigen::Vector2d origin_;
  std::array<std::vector<std::uint8_t>, kLevels> values_;
};

/// A square of shifts at one angle, 2^level each way, with an upper bound of their scores; at level
/// 0 a single shift with its score.
struct Block {
  int bound;
  int level;
  int angle;
  int x;  ///< of its first shift [fine cells]
  int y;

  friend bool operator<(const Block& a, const Block& b) {  // ties in a fixed order
    if (a.bound != b.bound) return a.bound < b.bound;
    if (a.level != b.level) return a.level > b.level;
    if (a.angle != b.angle) return a.angle > b.angle;
    if (a.y != b.y) return a.y > b.y;
    return a.x > b.x;
  }
};

/// Where in the grid a point finds its value, on each level, when the scan is turned to one angle.
using TurnedPoint = std::array<int, kLevels>;

/// Evenly chosen points within reach of the lookup grid.
std::vector<Eigen::Vector2d> choose_points(const std::vector<SurfacePoint>& points,
                                           const CorrelativeSearchParams& params) {
  std::vector<Eigen::Vector2d> near;
  near.reserve(points.size());
  for (const auto& point : points) {
    if (point.p.norm() < params.reach_m) near.push_back(point.p);
  }
  const auto n = near.size();
  const auto m = std::min(n, static_cast<std::size_t>(params.points_max));
  std::vector<Eigen::Vector2d> chosen;
  chosen.reserve(m);
  for (std::size_t i = 0; i < m; ++i) chosen.push_back(near[i * n / m]);
  return chosen;
}

double farthest(const std::vector<Eigen::Vector2d>& points) {
  double squared = 0.0;
  for (const auto& p : points) squared = std::max(squared, p.squaredNorm());
  return std::sqrt(squared);
}

/// One search by branch and bound: the grid, the scan at every angle, and the blocks of shifts
/// still to be looked into, best bound first.
class Search {
 public:
  Search(const std::vector<SurfacePoint>& points_body, const SurfelMap& reference,
         const Pose2& centre, const SearchWindow& window, const CorrelativeSearchParams& params)
      : params_(params),
        centre_(centre),
        points_(choose_points(points_body, params)),
        angles_(static_cast<int>(std::ceil(window.angle_rad / params.angle_step_rad))),
        blocks_wide_(static_cast<int>(std::ceil(window.radius_m / (params.cell_m * kBlock)))),
        grid_(params.cell_m, farthest(points_) + (blocks_wide_ + 2) * kBlock * params.cell_m,
              centre.translation()) {
    for (const auto& surfel : reference.surfels()) grid_.stamp(surfel.p);
    const int row = 2 * blocks_wide_ + 1;
    turned_.reserve((2 * angles_ + 1) * points_.size());
    blocks_.reserve(static_cast<std::size_t>(2 * angles_ + 1) * row * row);
    for (int a = 0; a <= 2 * angles_; ++a) {
      turn(angle(a));
      for (int y = -blocks_wide_; y <= blocks_wide_; ++y) {
        for (int x = -blocks_wide_; x <= blocks_wide_; x += kRow) push_row(a, x, y);
      }
    }
    std::make_heap(blocks_.begin(), blocks_.end());
  }

  std::vector<CorrelationPeak> best(int peaks) {
    std::vector<CorrelationPeak> found;
    if (points_.empty()) return found;
    for (int opened = 0; !blocks_.empty() && opened < params_.blocks_max; ++opened) {
      std::pop_heap(blocks_.begin(), blocks_.end());
      const Block block = blocks_.back();
      blocks_.pop_back();
      if (on_found_hill(block)) continue;
      if (block.level > 0) {
        split(block);
        continue;
      }
      // Shifts come in order of their scores, so the first of each hill is its top.
      tops_.push_back(block);
      found.push_back(peak(block));
      if (static_cast<int>(found.size()) == peaks) break;  // nothing left can be better
    }
    return found;
  }

 private:
  static constexpr int kBlock = 1 << (kLevels - 1);

  [[nodiscard]] double angle(int a) const {
    return wrap_angle(centre_.theta + (a - angles_) * params_.angle_step_rad);
  }

  void turn(double theta) {
    const double c = std::cos(theta);
    const double s = std::sin(theta);
    for (const auto& p : points_) {
      const int x = grid_.index_x(centre_.x + c * p.x() - s * p.y());
      const int y = grid_.index_y(centre_.y + s * p.x() + c * p.y());
      auto& cells = turned_.emplace_back();
      for (int level = 0; level < kLevels; ++level) {
        cells[level] = grid_.place(level, x, y);
      }
    }
  }

  [[nodiscard]] const TurnedPoint* turned(int a) const { return &turned_[a * points_.size()]; }

  /// Adds the coarsest blocks from (x, y) along x, up to kRow of them and to the end of the window.
  /// All are summed at once, the values of neighbours being neighbours in the grid.
  void push_row(int a, int x, int y) {
    constexpr int kLevel = kLevels - 1;
    const std::uint8_t* values = grid_.values(kLevel, x, y);
    std::array<std::int32_t, kRow> bounds{};
    const TurnedPoint* points = turned(a);
    for (std::size_t i = 0; i < points_.size(); ++i) {
      const std::uint8_t* row = values + points[i][kLevel];
      for (int k = 0; k < kRow; ++k) bounds[k] += row[k];
    }
    for (int k = 0; k < kRow && x + k <= blocks_wide_; ++k) {
      blocks_.push_back({bounds[k], kLevel, a, (x + k) * kBlock, y * kBlock});
    }
  }

  void split(const Block& block) {
    const int level = block.level - 1;
    const int side = grid_.side(level);
    const std::uint8_t* values = grid_.values(level, block.x >> level, block.y >> level);
    std::array<int, 4> bounds{};
    const TurnedPoint* points = turned(block.angle);
    for (std::size_t i = 0; i < points_.size(); ++i) {
      const std::uint8_t* corner = values + points[i][level];
      bounds[0] += corner[0];
      bounds[1] += corner[1];
      bounds[2] += corner[side];
      bounds[3] += corner[side + 1];
    }
    for (int k = 0; k < 4; ++k) {
      const int half = 1 << level;
      blocks_.push_back(
          {bounds[k], level, block.angle, block.x + (k & 1) * half, block.y + (k >> 1) * half});
      std::push_heap(blocks_.begin(), blocks_.end());
    }
  }

  /// Do all shifts of the block lie within a coarse step of a peak that was found?
  [[nodiscard]] bool on_found_hill(const Block& block) const {
    const int last = (1 << block.level) - 1;
    return std::any_of(tops_.begin(), tops_.end(), [&](const Block& top) {
      const int x = std::max(top.x - block.x, block.x + last - top.x);
      const int y = std::max(top.y - block.y, block.y + last - top.y);
      return x * x + y * y <= kBlock * kBlock && std::abs(block.angle - top.angle) <= kBlock;
    });
  }

  [[nodiscard]] CorrelationPeak peak(const Block& shift) const {
    return {{centre_.x + shift.x * params_.cell_m, centre_.y + shift.y * params_.cell_m,
             angle(shift.angle)},
            shift.bound / (255.0 * static_cast<double>(points_.size()))};
  }

  const CorrelativeSearchParams& params_;
  Pose2 centre_;
  std::vector<Eigen::Vector2d> points_;
  int angles_;
  int blocks_wide_;
  LookupGrid grid_;
  std::vector<TurnedPoint> turned_;  ///< all of the first angle, then all of the next
  std::vector<Block> blocks_;
  std::vector<Block> tops_;  ///< of the hills found
};

}  // namespace

std::vector<CorrelationPeak> search_correlation(const std::vector<SurfacePoint>& points_body,
                                                const SurfelMap& reference, const Pose2& centre,
                                                const SearchWindow& window, int peaks,
                                                const CorrelativeSearchParams& params) {
  if (points_body.empty() || reference.empty()) return {};
  return Search(points_body, reference, centre, window, params).best(peaks);
}

}  // namespace adit

// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "common/registration/correlative_search.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <span>

#include "common/geometry/symmetric_eigen.hpp"

namespace adit {
namespace {

constexpr int kLevelsMin = 3;  // blocks of 1, 2 and 4 shifts a side
constexpr int kLevelsMax = 7;
constexpr int kBlocksWide = 8;  // more of the coarsest blocks per side add a level
constexpr int kRow = 8;         // adjacent blocks that are bounded together

int levels_for(double radius, double cell) {
  int levels = kLevelsMin;
  while (levels < kLevelsMax && radius > kBlocksWide * cell * (1 << (levels - 1))) ++levels;
  return levels;
}

/// Lookup table of Olson 2009: closeness to the reference in [0, 255] around the search centre, for
/// each fine cell on several levels. A level holds the maximum over the cell and the next 2^level −
/// 1 cells on each axis, which is the tightest bound for all shifts of less than that. The grid is
/// large enough that no point at any shift of the search falls outside, so that the sums need no
/// checks.
class LookupGrid {
 public:
  LookupGrid(double cell, double half_width, int levels, const Eigen::Vector2d& centre)
      : cell_(cell), values_(levels) {
    const int coarsest = 1 << (levels - 1);
    side_ = (static_cast<int>(std::ceil(2.0 * half_width / (cell * coarsest))) + 2) * coarsest;
    origin_ = centre - Eigen::Vector2d::Constant(0.5 * side_ * cell);
    for (auto& values : values_) values.assign(static_cast<std::size_t>(side_) * side_ + kRow, 0);
  }

  [[nodiscard]] int index_x(double x) const { return static_cast<int>((x - origin_.x()) / cell_); }
  [[nodiscard]] int index_y(double y) const { return static_cast<int>((y - origin_.y()) / cell_); }

  /// Values of a level, offset by a number of blocks; kRow values may be read from any position.
  [[nodiscard]] const std::uint8_t* values(int level, int blocks_x, int blocks_y) const {
    return values_[level].data() + static_cast<std::ptrdiff_t>(blocks_y) * side(level) + blocks_x;
  }

  /// Position of the value of a fine cell. Cells that differ by a multiple of 2^level fine cells
  /// are adjacent: one step in x is 1, one in y is `side`.
  [[nodiscard]] int position(int level, int x, int y) const {
    const int phases = 1 << level;
    const int phase = ((y & (phases - 1)) << level) + (x & (phases - 1));
    return (phase * side(level) + (y >> level)) * side(level) + (x >> level);
  }
  [[nodiscard]] int side(int level) const { return side_ >> level; }

  void stamp(const Eigen::Vector2d& p) {
    const int cx = index_x(p.x());
    const int cy = index_y(p.y());
    if (cx < 1 || cy < 1 || cx >= side_ - 1 || cy >= side_ - 1) return;
    if (values_[0][cy * side_ + cx] == kCloseness[0]) return;  // already stamped
    for (int level = 0; level < static_cast<int>(values_.size()); ++level) stamp(level, cx, cy);
  }

 private:
  static constexpr std::array<std::uint8_t, 3> kCloseness{255, 140, 80};  // same, edge, corner

  /// Updates all cells whose maximum includes the fine cell (cx, cy) or one of its neighbours.
  void stamp(int level, int cx, int cy) {
    const int width = 1 << level;
    const auto off = [&](int u, int c) { return u > c || u + width <= c ? 1 : 0; };
    for (int v = std::max(cy - width, 0); v <= cy + 1; ++v) {
      for (int u = std::max(cx - width, 0); u <= cx + 1; ++u) {
        auto& value = values_[level][position(level, u, v)];
        value = std::max(value, kCloseness[off(u, cx) + off(v, cy)]);
      }
    }
  }

  double cell_;
  int side_ = 0;
  Eigen::Vector2d origin_;
  std::vector<std::vector<std::uint8_t>> values_;
};

/// A square of 2^level by 2^level shifts at one angle, with an upper bound of their scores; at
/// level 0 a single shift with its score.
struct Block {
  int bound;
  int level;
  int angle;
  int x;  ///< first shift [fine cells]
  int y;

  friend bool operator<(const Block& a, const Block& b) {  // ties are broken by a fixed rule
    if (a.bound != b.bound) return a.bound < b.bound;
    if (a.level != b.level) return a.level > b.level;
    if (a.angle != b.angle) return a.angle > b.angle;
    if (a.y != b.y) return a.y > b.y;
    return a.x > b.x;
  }
};

/// Evenly sampled points within reach of the lookup grid.
std::vector<Eigen::Vector2d> choose_points(const std::vector<SurfacePoint>& points,
                                           const CorrelativeSearchParams& params) {
  std::vector<Eigen::Vector2d> near;
  near.reserve(points.size());
  for (const auto& point : points) {
    if (point.p.norm() < params.range_max_m) near.push_back(point.p);
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

/// The Gaussian gate of the search: an ellipsoid, in the axes of the reference.
class Gate {
 public:
  Gate(const SearchWindow& window, double theta) : sigmas_(window.sigmas) {
    const Eigen::Matrix3d turn = adjoint(Pose2{0.0, 0.0, theta});
    information_ = turn * window.information * turn.transpose();
    const Eigen::Matrix2d plane = information_.topLeftCorner<2, 2>();
    sigmas_per_m_ = std::sqrt(std::max(0.0, symmetric_eigen(plane).values.y()));
  }

  /// Whether any pose at this turn, within `radius` of this shift, lies in the gate. Conservative:
  /// may return true where none does.
  [[nodiscard]] bool touches(const Eigen::Vector3d& off, double radius) const {
    if (sigmas_ <= 0.0) return true;
    const double reach = sigmas_ + radius * sigmas_per_m_;
    return off.dot(information_ * off) <= reach * reach;
  }

 private:
  double sigmas_;
  Eigen::Matrix3d information_;
  double sigmas_per_m_;
};

/// The search over blocks of shifts: the lookup grid, the scan at every angle, and the blocks
/// still open, best bound first (Olson 2009).
class BranchAndBound {
 public:
  BranchAndBound(const std::vector<SurfacePoint>& points_body, const SurfelMap& reference,
                 const Pose2& centre, const SearchWindow& window,
                 const CorrelativeSearchParams& params)
      : params_(params),
        centre_(centre),
        gate_(window, centre.theta),
        points_(choose_points(points_body, params)),
        bound_min_(params.score_min * kScoreMax * static_cast<double>(points_.size())),
        angles_(static_cast<int>(std::ceil(window.angle_rad / params.angle_step_rad))),
        levels_(levels_for(window.radius_m, params.cell_m)),
        coarsest_(1 << (levels_ - 1)),
        blocks_wide_(static_cast<int>(std::ceil(window.radius_m / (params.cell_m * coarsest_)))),
        grid_(params.cell_m, farthest(points_) + (blocks_wide_ + 2) * coarsest_ * params.cell_m,
              levels_, centre.translation()),
        positions_(points_.size() * levels_ * (2 * angles_ + 1)) {
    for (const auto& surfel : reference.surfels()) grid_.stamp(surfel.p);
    const int row = 2 * blocks_wide_ + 1;
    blocks_.reserve(static_cast<std::size_t>(2 * angles_ + 1) * row * row);
    for (int a = 0; a <= 2 * angles_; ++a) {
      turn(a);
      for (int y = -blocks_wide_; y <= blocks_wide_; ++y) push_row(a, y);
    }
    std::make_heap(blocks_.begin(), blocks_.end());
  }

  std::vector<CorrelationPeak> best(int peaks) {
    std::vector<CorrelationPeak> found;
    if (points_.empty()) return found;
    for (int expanded = 0; !blocks_.empty() && expanded < params_.blocks_max; ++expanded) {
      std::pop_heap(blocks_.begin(), blocks_.end());
      const Block block = blocks_.back();
      blocks_.pop_back();
      if (is_near_found_peak(block)) continue;
      if (block.level > 0) {
        split(block);
        continue;
      }
      // Shifts arrive in descending order of score, so the first of a peak is its top.
      tops_.push_back(block);
      found.push_back(peak(block));
      if (static_cast<int>(found.size()) == peaks) break;  // no open block has a better bound
    }
    return found;
  }

 private:
  static constexpr double kScoreMax = 255.0;  // maximum score of a point

  [[nodiscard]] double angle(int a) const {
    return wrap_angle(centre_.theta + (a - angles_) * params_.angle_step_rad);
  }

  void turn(int a) {
    const double c = std::cos(angle(a));
    const double s = std::sin(angle(a));
    for (std::size_t i = 0; i < points_.size(); ++i) {
      const auto& p = points_[i];
      const int x = grid_.index_x(centre_.x + c * p.x() - s * p.y());
      const int y = grid_.index_y(centre_.y + s * p.x() + c * p.y());
      for (int level = 0; level < levels_; ++level) {
        positions_[first_position(a, level) + i] = grid_.position(level, x, y);
      }
    }
  }

  [[nodiscard]] std::size_t first_position(int a, int level) const {
    return (static_cast<std::size_t>(a) * levels_ + level) * points_.size();
  }

  /// Positions in the grid of the values of the points, with the scan turned to angle `a`.
  [[nodiscard]] std::span<const int> positions(int a, int level) const {
    return std::span(positions_).subspan(first_position(a, level), points_.size());
  }

  /// Whether a block with its first shift at (x, y) touches the gate.
  [[nodiscard]] bool in_gate(int level, int a, int x, int y) const {
    const double half = 0.5 * ((1 << level) - 1) * params_.cell_m;
    const Eigen::Vector3d off(x * params_.cell_m + half, y * params_.cell_m + half,
                              (a - angles_) * params_.angle_step_rad);
    return gate_.touches(off, std::sqrt(2.0) * half);
  }

  /// Adds the coarsest blocks of a row of the window. Blocks in the gate are contiguous.
  void push_row(int a, int y) {
    const auto outside = [&](int x) {
      return !in_gate(levels_ - 1, a, x * coarsest_, y * coarsest_);
    };
    int first = -blocks_wide_;
    int last = blocks_wide_;
    while (first <= last && outside(first)) ++first;
    while (first < last && outside(last)) --last;
    for (int x = first; x <= last; x += kRow) push_blocks(a, x, std::min(x + kRow - 1, last), y);
  }

  /// Adds the coarsest blocks from x to last, up to kRow of them. All are summed in one pass, as
  /// the values of neighbours are adjacent in the grid.
  void push_blocks(int a, int x, int last, int y) {
    const int level = levels_ - 1;
    const std::uint8_t* values = grid_.values(level, x, y);
    std::array<std::int32_t, kRow> bounds{};
    for (const int position : positions(a, level)) {
      const std::uint8_t* row = values + position;
      for (int k = 0; k < kRow; ++k) bounds[k] += row[k];
    }
    for (int k = 0; x + k <= last; ++k) {
      if (bounds[k] < bound_min_) continue;
      blocks_.push_back({bounds[k], level, a, (x + k) * coarsest_, y * coarsest_});
    }
  }

  void split(const Block& block) {
    const int level = block.level - 1;
    const int side = grid_.side(level);
    const std::uint8_t* values = grid_.values(level, block.x >> level, block.y >> level);
    std::array<int, 4> bounds{};
    for (const int position : positions(block.angle, level)) {
      const std::uint8_t* corner = values + position;
      bounds[0] += corner[0];
      bounds[1] += corner[1];
      bounds[2] += corner[side];
      bounds[3] += corner[side + 1];
    }
    for (int k = 0; k < 4; ++k) {
      const int half = 1 << level;
      const Block part{bounds[k], level, block.angle, block.x + (k & 1) * half,
                       block.y + (k >> 1) * half};
      if (part.bound < bound_min_ || !in_gate(level, part.angle, part.x, part.y)) continue;
      blocks_.push_back(part);
      std::push_heap(blocks_.begin(), blocks_.end());
    }
  }

  /// Whether all shifts of the block lie within the separation of a peak that was found.
  [[nodiscard]] bool is_near_found_peak(const Block& block) const {
    const int apart = params_.peak_separation_cells;
    const int last = (1 << block.level) - 1;
    return std::any_of(tops_.begin(), tops_.end(), [&](const Block& top) {
      const int x = std::max(top.x - block.x, block.x + last - top.x);
      const int y = std::max(top.y - block.y, block.y + last - top.y);
      if (x * x + y * y > apart * apart) return false;
      // Half a step of tolerance: 2π is not a multiple of the angle step.
      const double turn = angle_diff(angle(block.angle), angle(top.angle));
      return std::abs(turn) < (apart + 0.5) * params_.angle_step_rad;
    });
  }

  [[nodiscard]] CorrelationPeak peak(const Block& shift) const {
    return {{centre_.x + shift.x * params_.cell_m, centre_.y + shift.y * params_.cell_m,
             angle(shift.angle)},
            shift.bound / (kScoreMax * static_cast<double>(points_.size()))};
  }

  const CorrelativeSearchParams& params_;
  Pose2 centre_;
  Gate gate_;
  std::vector<Eigen::Vector2d> points_;
  double bound_min_;  ///< blocks with a lower bound are discarded
  int angles_;
  int levels_;
  int coarsest_;  ///< shifts per side of a coarsest block
  int blocks_wide_;
  LookupGrid grid_;
  std::vector<int> positions_;  ///< by angle, level and point
  std::vector<Block> blocks_;
  std::vector<Block> tops_;  ///< tops of the peaks found
};

}  // namespace

std::vector<CorrelationPeak> search_correlation(const std::vector<SurfacePoint>& points_body,
                                                const SurfelMap& reference, const Pose2& centre,
                                                const SearchWindow& window, int peaks,
                                                const CorrelativeSearchParams& params) {
  if (points_body.empty() || reference.empty()) return {};
  return BranchAndBound(points_body, reference, centre, window, params).best(peaks);
}

}  // namespace adit

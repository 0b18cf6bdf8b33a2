// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "common/registration/correlative_search.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>

namespace adit {
namespace {

constexpr int kLevels = 3;  // cells of 1, 2 and 4 fine cells each way

/// Closeness to the reference in [0, 255] around the search centre, on several levels. A cell of a
/// coarse level holds the maximum over itself and the next cell each way: an upper bound for every
/// shift of less than its side. Large enough that no point at any shift of the search falls
/// outside, so that sums need no checks.
class LookupGrid {
 public:
  LookupGrid(double cell, double half_width, const Eigen::Vector2d& centre) : cell_(cell) {
    constexpr int kCoarsest = 1 << (kLevels - 1);
    side_ = (static_cast<int>(std::ceil(2.0 * half_width / (cell * kCoarsest))) + 2) * kCoarsest;
    origin_ = centre - Eigen::Vector2d::Constant(0.5 * side_ * cell);
    for (int level = 0; level < kLevels; ++level) {
      values_[level].assign(static_cast<std::size_t>(side(level)) * side(level), 0);
    }
  }

  [[nodiscard]] int index_x(double x) const { return static_cast<int>((x - origin_.x()) / cell_); }
  [[nodiscard]] int index_y(double y) const { return static_cast<int>((y - origin_.y()) / cell_); }
  [[nodiscard]] int side(int level) const { return side_ >> level; }
  [[nodiscard]] const std::uint8_t* values(int level) const { return values_[level].data(); }

  void stamp(const Eigen::Vector2d& p) {
    constexpr std::array<std::uint8_t, 3> kCloseness{255, 140, 80};  // same cell, beside, corner
    const int cx = index_x(p.x());
    const int cy = index_y(p.y());
    if (cx < 1 || cy < 1 || cx >= side_ - 1 || cy >= side_ - 1) return;
    for (int dy = -1; dy <= 1; ++dy) {
      for (int dx = -1; dx <= 1; ++dx) {
        raise(cx + dx, cy + dy, kCloseness[std::abs(dx) + std::abs(dy)]);
      }
    }
  }

 private:
  void raise(int x, int y, std::uint8_t value) {
    auto& fine = values_[0][y * side_ + x];
    if (fine >= value) return;
    fine = value;
    for (int level = 1; level < kLevels; ++level) {
      const int cx = x >> level;
      const int cy = y >> level;
      for (int v = std::max(cy - 1, 0); v <= cy; ++v) {
        for (int u = std::max(cx - 1, 0); u <= cx; ++u) {
          auto& bound = values_[level][v * side(level) + u];
          bound = std::max(bound, value);
        }
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

/// Where the points of the scan fall in the grid, on each level, when it is turned to one angle.
using TurnedScan = std::array<std::vector<int>, kLevels>;

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
        grid_(params.cell_m, params.reach_m + (blocks_wide_ + 2) * kBlock * params.cell_m,
              centre.translation()) {
    for (const auto& surfel : reference.surfels()) grid_.stamp(surfel.p);
    for (int a = 0; a <= 2 * angles_; ++a) turned_.push_back(turn(angle(a)));
    for (int a = 0; a <= 2 * angles_; ++a) {
      for (int y = -blocks_wide_; y <= blocks_wide_; ++y) {
        for (int x = -blocks_wide_; x <= blocks_wide_; ++x) {
          blocks_.push_back(bounded(kLevels - 1, a, x * kBlock, y * kBlock));
        }
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
      if (block.level > 0) {
        split(block);
      } else if (add(found, block); static_cast<int>(found.size()) == peaks) {
        break;  // nothing left can be better
      }
    }
    return found;
  }

 private:
  static constexpr int kBlock = 1 << (kLevels - 1);

  [[nodiscard]] double angle(int a) const {
    return wrap_angle(centre_.theta + (a - angles_) * params_.angle_step_rad);
  }

  [[nodiscard]] TurnedScan turn(double theta) const {
    const double c = std::cos(theta);
    const double s = std::sin(theta);
    TurnedScan turned;
    for (auto& cells : turned) cells.reserve(points_.size());
    for (const auto& p : points_) {
      const int x = grid_.index_x(centre_.x + c * p.x() - s * p.y());
      const int y = grid_.index_y(centre_.y + s * p.x() + c * p.y());
      for (int level = 0; level < kLevels; ++level) {
        turned[level].push_back((y >> level) * grid_.side(level) + (x >> level));
      }
    }
    return turned;
  }

  [[nodiscard]] Block bounded(int level, int a, int x, int y) const {
    const std::uint8_t* values = grid_.values(level);
    const int shift = (y >> level) * grid_.side(level) + (x >> level);
    int bound = 0;
    for (const int cell : turned_[a][level]) bound += values[cell + shift];
    return {bound, level, a, x, y};
  }

  void split(const Block& block) {
    const int half = 1 << (block.level - 1);
    for (int dy = 0; dy <= half; dy += half) {
      for (int dx = 0; dx <= half; dx += half) {
        blocks_.push_back(bounded(block.level - 1, block.angle, block.x + dx, block.y + dy));
        std::push_heap(blocks_.begin(), blocks_.end());
      }
    }
  }

  /// Shifts come in order of their scores, so the first of each hill is its top.
  void add(std::vector<CorrelationPeak>& found, const Block& shift) const {
    const Pose2 T{centre_.x + shift.x * params_.cell_m, centre_.y + shift.y * params_.cell_m,
                  angle(shift.angle)};
    const auto same_hill = [&](const CorrelationPeak& other) {
      const Pose2 apart = between(other.T_odom_body, T);
      return apart.translation().norm() < kBlock * params_.cell_m &&
             std::abs(apart.theta) < kBlock * params_.angle_step_rad;
    };
    if (std::any_of(found.begin(), found.end(), same_hill)) return;
    found.push_back({T, shift.bound / (255.0 * points_.size())});
  }

  const CorrelativeSearchParams& params_;
  Pose2 centre_;
  std::vector<Eigen::Vector2d> points_;
  int angles_;
  int blocks_wide_;
  LookupGrid grid_;
  std::vector<TurnedScan> turned_;
  std::vector<Block> blocks_;
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

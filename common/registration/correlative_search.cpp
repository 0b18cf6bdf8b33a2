// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "common/registration/correlative_search.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>

#include <Eigen/Eigenvalues>

namespace adit {
namespace {

constexpr int kLevelsMin = 3;  // cells of 1, 2 and 4 fine cells each way
constexpr int kLevelsMax = 7;
constexpr int kBlocksWide = 8;  // more of the coarsest blocks on each side ask for another level

int levels_for(double radius, double cell) {
  int levels = kLevelsMin;
  while (levels < kLevelsMax && radius > kBlocksWide * cell * (1 << (levels - 1))) ++levels;
  return levels;
}

/// Closeness to the reference in [0, 255] around the search centre, on several levels. A cell of a
/// coarse level holds the maximum over itself and the next cell each way: an upper bound for every
/// shift of less than its side. Large enough that no point at any shift of the search falls
/// outside, so that sums need no checks.
class LookupGrid {
 public:
  LookupGrid(double cell, double half_width, int levels, const Eigen::Vector2d& centre)
      : cell_(cell), values_(levels) {
    const int coarsest = 1 << (levels - 1);
    side_ = (static_cast<int>(std::ceil(2.0 * half_width / (cell * coarsest))) + 2) * coarsest;
    origin_ = centre - Eigen::Vector2d::Constant(0.5 * side_ * cell);
    for (int level = 0; level < levels; ++level) {
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
        auto& fine = values_[0][(cy + dy) * side_ + cx + dx];
        fine = std::max(fine, kCloseness[std::abs(dx) + std::abs(dy)]);
      }
    }
  }

  /// To be called once, when all is stamped.
  void make_bounds() {
    for (int level = 1; level < static_cast<int>(values_.size()); ++level) gather(level);
    for (int level = 1; level < static_cast<int>(values_.size()); ++level) widen(level);
  }

 private:
  /// The maximum over the four cells of the level below.
  void gather(int level) {
    const std::ptrdiff_t n = side(level);
    const std::ptrdiff_t next_row = 2 * n;
    for (std::ptrdiff_t y = 0; y < n; ++y) {
      for (std::ptrdiff_t x = 0; x < n; ++x) {
        const std::uint8_t* four = values_[level - 1].data() + 2 * (y * next_row + x);
        values_[level][y * n + x] =
            std::max(std::max(four[0], four[1]), std::max(four[next_row], four[next_row + 1]));
      }
    }
  }

  /// The maximum over each cell and the next each way.
  void widen(int level) {
    const int n = side(level);
    auto& values = values_[level];
    for (int i = 0; i + 1 < n * n; ++i) values[i] = std::max(values[i], values[i + 1]);
    for (int i = 0; i + n < n * n; ++i) values[i] = std::max(values[i], values[i + n]);
  }

  double cell_;
  int side_ = 0;
  Eigen::Vector2d origin_;
  std::vector<std::vector<std::uint8_t>> values_;
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
using TurnedScan = std::vector<std::vector<int>>;

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

/// What part of the window is searched: an ellipsoid, in the axes of the reference.
class Gate {
 public:
  Gate(const SearchWindow& window, double theta) : sigmas_(window.sigmas) {
    const Eigen::Matrix3d turn = adjoint(Pose2{0.0, 0.0, theta});
    information_ = turn * window.information * turn.transpose();
    const Eigen::SelfAdjointEigenSolver<Eigen::Matrix2d> plane(
        Eigen::Matrix2d(information_.topLeftCorner<2, 2>()), Eigen::EigenvaluesOnly);
    sigmas_per_m_ = std::sqrt(std::max(0.0, plane.eigenvalues().y()));
  }

  /// Is any pose of these in the gate: at this turn, within `radius` of this shift? Sometimes says
  /// yes where it is no.
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

/// One search by branch and bound: the grid, the scan at every angle, and the blocks of shifts
/// still to be looked into, best bound first.
class Search {
 public:
  Search(const std::vector<SurfacePoint>& points_body, const SurfelMap& reference,
         const Pose2& centre, const SearchWindow& window, const CorrelativeSearchParams& params)
      : params_(params),
        centre_(centre),
        gate_(window, centre.theta),
        points_(choose_points(points_body, params)),
        angles_(static_cast<int>(std::ceil(window.angle_rad / params.angle_step_rad))),
        levels_(levels_for(window.radius_m, params.cell_m)),
        coarsest_(1 << (levels_ - 1)),
        blocks_wide_(static_cast<int>(std::ceil(window.radius_m / (params.cell_m * coarsest_)))),
        grid_(params.cell_m, params.reach_m + (blocks_wide_ + 2) * coarsest_ * params.cell_m,
              levels_, centre.translation()) {
    for (const auto& surfel : reference.surfels()) grid_.stamp(surfel.p);
    grid_.make_bounds();
    for (int a = 0; a <= 2 * angles_; ++a) turned_.push_back(turn(angle(a)));
    for (int a = 0; a <= 2 * angles_; ++a) {
      for (int y = -blocks_wide_; y <= blocks_wide_; ++y) {
        for (int x = -blocks_wide_; x <= blocks_wide_; ++x) {
          propose(levels_ - 1, a, x * coarsest_, y * coarsest_);
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
      if (on_known_hill(found, block)) continue;
      if (block.level > 0) {
        split(block);
        continue;
      }
      found.push_back({pose(block), block.bound / (255.0 * points_.size())});
      if (static_cast<int>(found.size()) == peaks) break;  // nothing left can be better
    }
    return found;
  }

 private:
  [[nodiscard]] double angle(int a) const {
    return wrap_angle(centre_.theta + (a - angles_) * params_.angle_step_rad);
  }

  [[nodiscard]] Pose2 pose(const Block& shift) const {
    return {centre_.x + shift.x * params_.cell_m, centre_.y + shift.y * params_.cell_m,
            angle(shift.angle)};
  }

  [[nodiscard]] TurnedScan turn(double theta) const {
    const double c = std::cos(theta);
    const double s = std::sin(theta);
    TurnedScan turned(levels_);
    for (auto& cells : turned) cells.reserve(points_.size());
    for (const auto& p : points_) {
      const int x = grid_.index_x(centre_.x + c * p.x() - s * p.y());
      const int y = grid_.index_y(centre_.y + s * p.x() + c * p.y());
      for (int level = 0; level < levels_; ++level) {
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

  /// Adds a block to those to be looked into, if anything in it can be a result.
  bool propose(int level, int a, int x, int y) {
    const double half = 0.5 * ((1 << level) - 1) * params_.cell_m;
    const Eigen::Vector3d off(x * params_.cell_m + half, y * params_.cell_m + half,
                              (a - angles_) * params_.angle_step_rad);
    if (!gate_.touches(off, std::sqrt(2.0) * half)) return false;
    const Block block = bounded(level, a, x, y);
    if (block.bound < params_.score_min * 255.0 * points_.size()) return false;
    blocks_.push_back(block);
    return true;
  }

  void split(const Block& block) {
    const int half = 1 << (block.level - 1);
    for (int dy = 0; dy <= half; dy += half) {
      for (int dx = 0; dx <= half; dx += half) {
        if (propose(block.level - 1, block.angle, block.x + dx, block.y + dy)) {
          std::push_heap(blocks_.begin(), blocks_.end());
        }
      }
    }
  }

  /// Shifts come in order of their scores, so the first of each hill is its top. A block with all
  /// its corners on a hill has nothing else in it.
  [[nodiscard]] bool on_known_hill(const std::vector<CorrelationPeak>& found,
                                   const Block& block) const {
    const double width = ((1 << block.level) - 1) * params_.cell_m;
    const Pose2 first = pose(block);
    return std::any_of(found.begin(), found.end(), [&](const CorrelationPeak& peak) {
      const double turn = angle_diff(first.theta, peak.T_odom_body.theta);
      if (std::abs(turn) >= params_.apart_cells * params_.angle_step_rad) return false;
      const Eigen::Vector2d d = first.translation() - peak.T_odom_body.translation();
      const Eigen::Vector2d farthest =
          d.cwiseAbs().cwiseMax((d + Eigen::Vector2d::Constant(width)).cwiseAbs());
      return farthest.norm() < params_.apart_cells * params_.cell_m;
    });
  }

  const CorrelativeSearchParams& params_;
  Pose2 centre_;
  Gate gate_;
  std::vector<Eigen::Vector2d> points_;
  int angles_;
  int levels_;
  int coarsest_;  ///< cells on the side of a coarsest block
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

// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "procs/planning/passage/passage.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <functional>
#include <limits>
#include <numbers>
#include <queue>
#include <utility>

#include <Eigen/Dense>

namespace adit {
namespace {

using Line = std::vector<Eigen::Vector2d>;

constexpr double kSpacingM = 0.1;  // of the poses of the band
constexpr double kMiddleCost =
    4.0;  // of a metre of cells at the walls, more than one in the middle
constexpr double kProgressGain = 8.0;  // of a metre of progress, for that of the farthest cell
constexpr double kStartM = 1.2;   // over which walls beside the robot may be as near as they are
constexpr int kSmoothings = 100;  // of the chain of cells: over half a metre
constexpr int kIterations = 40;
constexpr int kSoftenings = 5;
constexpr double kStiffnessMax = 64.0;  // of curvature; at 2 the band bends over a metre
constexpr double kWidthMinM = 0.1;      // of the free width as a weight
constexpr double kConvergedM = 0.002;
constexpr double kShiftMaxM = 0.05;  // of a pose in an iteration
constexpr double kSimilarM = 0.3;    // of progress; then the clearance counts

/// The chain of cells from the robot to the cell with the most progress for its cost.
class Guide {
 public:
  Guide(const TerrainMap& terrain, const WallDistance& walls, const Vehicle& vehicle)
      : terrain_(terrain),
        walls_(walls),
        // A cell is up to half its diagonal beside the middle.
        free_m_(vehicle.width_m / 2.0 - terrain.cell_m / std::numbers::sqrt2),
        costs_(terrain.cells.size(), std::numeric_limits<double>::infinity()),
        from_(terrain.cells.size(), terrain.cells.size()) {}

  Line to_most_progress(const Eigen::Vector2d& p_level_body, const GoalField& goals) {
    const Eigen::Vector2i start = terrain_.cell_at(p_level_body);
    if (!terrain_.cells.contains(start)) return {};
    search(terrain_.cells.index(start));
    std::size_t best = terrain_.cells.index(start);
    for (std::size_t i = 0; i < costs_.size(); ++i) {
      if (std::isinf(costs_[i])) continue;
      if (gain(i, goals) > gain(best, goals)) best = i;
    }
    Line line;
    for (std::size_t i = best; i < costs_.size(); i = from_[i]) {
      const Eigen::Vector2i at = terrain_.cells.cell(i);
      line.push_back(terrain_.centre(at.x(), at.y()));
    }
    line.back() = p_level_body;
    std::ranges::reverse(line);
    return line;
  }

 private:
  [[nodiscard]] double gain(std::size_t cell, const GoalField& goals) const {
    return kProgressGain * goals.progress(cell) - terrain_.cell_m * costs_[cell];
  }

  void search(std::size_t start) {
    using Entry = std::pair<double, std::size_t>;
    std::priority_queue<Entry, std::vector<Entry>, std::greater<>> open;
    costs_[start] = 0.0;
    open.emplace(0.0, start);
    while (!open.empty()) {
      const auto [cost, i] = open.top();
      open.pop();
      if (cost > costs_[i]) continue;
      const Eigen::Vector2i at = terrain_.cells.cell(i);
      for (int dy = -1; dy <= 1; ++dy) {
        for (int dx = -1; dx <= 1; ++dx) {
          const Eigen::Vector2i next = at + Eigen::Vector2i(dx, dy);
          if (!terrain_.cells.contains(next)) continue;
          const double distance_m = walls_.at(terrain_.centre(next.x(), next.y()));
          if (distance_m < free_m_) continue;
          const double near =
              std::clamp(1.0 - (distance_m - free_m_) / WallDistance::kSideMaxM, 0.0, 1.0);
          const double through = cost + std::hypot(dx, dy) * (1.0 + kMiddleCost * near);
          const std::size_t k = terrain_.cells.index(next);
          if (through >= costs_[k]) continue;
          costs_[k] = through;
          from_[k] = i;
          open.emplace(through, k);
        }
      }
    }
  }

  const TerrainMap& terrain_;
  const WallDistance& walls_;
  double free_m_;
  std::vector<double> costs_;
  std::vector<std::size_t> from_;
};

/// The line with points at equal distances, `spacing_m` or less.
Line resampled(const Line& line, double spacing_m) {
  std::vector<double> s_m{0.0};
  for (std::size_t i = 1; i < line.size(); ++i)
    s_m.push_back(s_m.back() + (line[i] - line[i - 1]).norm());
  const auto segments = static_cast<std::size_t>(std::max(1.0, std::ceil(s_m.back() / spacing_m)));
  Line result;
  std::size_t k = 1;
  for (std::size_t i = 0; i <= segments; ++i) {
    const double s = s_m.back() * static_cast<double>(i) / static_cast<double>(segments);
    while (k + 1 < line.size() && s_m[k] < s) ++k;
    const double leg_m = s_m[k] - s_m[k - 1];
    const double share = leg_m > 0.0 ? std::clamp((s - s_m[k - 1]) / leg_m, 0.0, 1.0) : 0.0;
    result.push_back((1.0 - share) * line[k - 1] + share * line[k]);
  }
  return result;
}

Eigen::Vector2d tangent_at(const Line& line, std::size_t i) {
  const std::size_t before = i > 0 ? i - 1 : 0;
  const std::size_t after = std::min(i + 1, line.size() - 1);
  return (line[after] - line[before]).normalized();
}

Pose2 pose_at(const Line& line, std::size_t i) {
  const Eigen::Vector2d tangent = tangent_at(line, i);
  return {line[i].x(), line[i].y(), std::atan2(tangent.y(), tangent.x())};
}

/// The band: its first two points keep the place and the heading of the robot.
class Band {
 public:
  Band(const Line& guide, const Pose2& T_level_body, const WallDistance& walls)
      : walls_(walls), T_level_body_(T_level_body), line_(resampled(guide, kSpacingM)) {
    for (int i = 0; i < kSmoothings; ++i) {
      for (std::size_t k = 1; k + 1 < line_.size(); ++k)
        line_[k] = 0.5 * line_[k] + 0.25 * (line_[k - 1] + line_[k + 1]);
    }
    hold_start();
  }

  /// Bends the band; `stiffness` is that of curvature.
  void relax(double stiffness) {
    if (line_.size() < 5) return;
    for (int i = 0; i < kIterations && shift(stiffness) > kConvergedM; ++i) {
    }
  }

  [[nodiscard]] const Line& line() const { return line_; }

  [[nodiscard]] double curvature_1_m(std::size_t i) const {
    if (i == 0 || i + 1 >= line_.size()) return 0.0;
    const Eigen::Vector2d before = line_[i] - line_[i - 1];
    const Eigen::Vector2d after = line_[i + 1] - line_[i];
    const double turn =
        std::atan2(before.x() * after.y() - before.y() * after.x(), before.dot(after));
    return turn / (0.5 * (before.norm() + after.norm()));
  }

 private:
  /// One Gauss-Newton step: displacements y along the normals that minimise
  ///   Σ w (y − m)² + stiffness Σ (κ + y'')²,
  /// where m leads to the middle between the walls and w is one over half the free width. Returns
  /// the largest displacement.
  double shift(double stiffness) {
    const auto n = static_cast<Eigen::Index>(line_.size());
    const double step_m = (line_.back() - line_[line_.size() - 2]).norm();
    Eigen::MatrixXd A = Eigen::MatrixXd::Zero(n, n);
    Eigen::VectorXd b = Eigen::VectorXd::Zero(n);
    Line normals;
    for (Eigen::Index i = 0; i < n; ++i) {
      const auto k = static_cast<std::size_t>(i);
      const Eigen::Vector2d tangent = tangent_at(line_, k);
      normals.emplace_back(-tangent.y(), tangent.x());
      const WallDistance::Sides sides = walls_.sides(pose_at(line_, k));
      const double middle_m = (sides.left_m - sides.right_m) / 2.0;
      const double weight = 1.0 / std::max(kWidthMinM, (sides.left_m + sides.right_m) / 2.0);
      A(i, i) += weight;
      b(i) += weight * middle_m;
      if (i == 0 || i + 1 == n) continue;
      const Eigen::Vector3d second = Eigen::Vector3d(1.0, -2.0, 1.0) / (step_m * step_m);
      A.block<3, 3>(i - 1, i - 1) += stiffness * second * second.transpose();
      b.segment<3>(i - 1) -= stiffness * second * curvature_1_m(k);
    }
    const Eigen::Index free = n - 2;
    const Eigen::VectorXd y = A.bottomRightCorner(free, free).ldlt().solve(b.tail(free));
    double largest_m = 0.0;
    for (Eigen::Index i = 0; i < free; ++i) {
      const double by_m = std::clamp(y(i), -kShiftMaxM, kShiftMaxM);
      line_[static_cast<std::size_t>(i) + 2] += by_m * normals[static_cast<std::size_t>(i) + 2];
      largest_m = std::max(largest_m, std::abs(by_m));
    }
    hold_start();
    return largest_m;
  }

  /// Points at equal distances, from the robot on along its heading.
  void hold_start() {
    line_ = resampled(line_, kSpacingM);
    if (line_.size() < 2) return;
    const double step_m = (line_[1] - line_[0]).norm();
    line_[0] = T_level_body_.translation();
    line_[1] = T_level_body_ * Eigen::Vector2d(step_m, 0.0);
  }

  const WallDistance& walls_;
  Pose2 T_level_body_;
  Line line_;
};

/// Number of points of the band up to which the body fits and can steer, and their clearances.
std::vector<double> clearances(const Band& band, const WallDistance& walls, double curvature_max,
                               double clearance_min_m) {
  std::vector<double> clearances;
  const Line& line = band.line();
  double least_m = clearance_min_m;
  double s_m = 0.0;
  for (std::size_t i = 0; i < line.size(); ++i) {
    if (i > 0) s_m += (line[i] - line[i - 1]).norm();
    const double clearance_m = walls.clearance_m(pose_at(line, i));
    if (i == 0) least_m = std::min(clearance_min_m, clearance_m);
    if (clearance_m < (s_m < kStartM ? least_m : clearance_min_m)) break;
    if (std::abs(band.curvature_1_m(i)) > curvature_max) break;
    clearances.push_back(clearance_m);
  }
  return clearances;
}

double length_m(const Line& line, std::size_t points) {
  double length_m = 0.0;
  for (std::size_t i = 1; i < points; ++i) length_m += (line[i] - line[i - 1]).norm();
  return length_m;
}

std::vector<PathPoint> points_of(const Band& band, const std::vector<double>& clearances,
                                 std::size_t count, const TerrainMap& terrain, bool reverse) {
  std::vector<PathPoint> points;
  double s_m = 0.0;
  for (std::size_t i = 0; i < count; ++i) {
    if (i > 0) s_m += (band.line()[i] - band.line()[i - 1]).norm();
    Pose2 T_level_body = pose_at(band.line(), i);
    if (reverse) T_level_body = T_level_body * Pose2{0.0, 0.0, std::numbers::pi};
    // In reverse a turn to the left of the direction of travel is one to the right of the body.
    const double curvature_1_m = band.curvature_1_m(i) * (reverse ? -1.0 : 1.0);
    points.push_back({terrain.T_odom_level * T_level_body, i + 1 < count ? curvature_1_m : 0.0,
                      reverse, clearances[i], s_m});
  }
  return points;
}

}  // namespace

std::optional<PlannedPath> plan_passage(const TerrainMap& terrain, const WallDistance& walls,
                                        const GoalField& goals, const Pose2& T_level_body,
                                        bool reverse, const Vehicle& vehicle,
                                        const PassageParams& params) {
  const Line guide =
      Guide(terrain, walls, vehicle).to_most_progress(T_level_body.translation(), goals);
  if (guide.size() < 5) return std::nullopt;
  const Pose2 T_level_leading =
      reverse ? T_level_body * Pose2{0.0, 0.0, std::numbers::pi} : T_level_body;
  const double curvature_max = 1.0 / (vehicle.turning_radius_m * (1.0 + params.radius_reserve));
  std::optional<PlannedPath> best;
  Band band(guide, T_level_leading, walls);
  double stiffness = kStiffnessMax;
  double best_clearance_m = 0.0;
  for (int i = 0; i <= kSoftenings; ++i, stiffness /= 2.0) {
    band.relax(stiffness);
    const std::vector<double> free = clearances(band, walls, curvature_max, params.clearance_min_m);
    const double free_m = length_m(band.line(), free.size());
    std::size_t count = free.size();
    const bool to_end = count == band.line().size();
    while (!to_end && count > 1 && free_m - length_m(band.line(), count) < params.end_reserve_m) {
      --count;
    }
    if (count < 5) continue;
    const double reached_m = goals.progress(band.line()[count - 1]);
    const double least_m = *std::min_element(free.begin(), free.begin() + count);
    if (reached_m < goals.min_progress()) continue;
    if (best) {
      const double more_m = reached_m - best->reached_m;
      if (more_m < -kSimilarM || (more_m < kSimilarM && least_m <= best_clearance_m)) continue;
    }
    best_clearance_m = least_m;
    best.emplace();
    best->outcome = PlanOutcome::kFound;
    best->reason = "A path was found through a narrow passage.";
    best->points = points_of(band, free, count, terrain, reverse);
    best->reached_m = reached_m;
  }
  return best;
}

}  // namespace adit

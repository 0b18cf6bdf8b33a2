// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "tools/survey/frame/level_correction.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <optional>
#include <tuple>

#include <Eigen/Geometry>
#include <Eigen/LU>

#include "common/grid/grid2.hpp"
#include "procs/mapping/level_error.hpp"

namespace adit {
namespace {

constexpr double kPriorSdRad = 0.005;  // accelerometers and mounts
constexpr double kScanSdRad = 0.0015;  // of a single scan: noise of the attitude
constexpr double kCellM = 0.25;
constexpr double kRangeMaxM = 9.0;
constexpr double kFlatM = 0.1;          // spread of heights in a cell of floor or roof
constexpr std::size_t kReturnsMin = 3;  // in such a cell
constexpr double kApartMaxM = 8.0;      // between scans that see the same surfaces
constexpr double kTurnMinRad = 0.6;     // below, the error inclines both scans nearly alike
constexpr double kDifferenceMaxM = 0.25;
constexpr std::size_t kCellsMin = 60;
constexpr double kCellSdM = 0.02;  // of a height difference in a cell: relief, noise of ranges
constexpr double kCellsPerSample = 4.0;  // neighbours share the errors of a line

/// Floor or roof in a cell of the plan.
struct Patch {
  std::int32_t x = 0;
  std::int32_t y = 0;
  bool roof = false;
  double z_m = 0.0;

  [[nodiscard]] auto key() const { return std::tuple(x, y, roof); }
};

/// A return in the cells around a scan.
struct CellReturn {
  std::size_t cell = 0;
  double z_m = 0.0;
};

/// The cells of the plan within kRangeMaxM of a place, twice: below the laser, and above it.
/// Numbered in the order of Patch::key().
class CellsAround {
 public:
  explicit CellsAround(const Eigen::Vector2d& p_survey)
      : low_(cell_of(p_survey, kCellM).array() - kReach) {}

  [[nodiscard]] static std::size_t count() { return std::size_t{2} * kSide * kSide; }
  [[nodiscard]] std::size_t number_of(const Eigen::Vector2i& cell, bool roof) const {
    const Eigen::Vector2i at = cell - low_;
    const auto x = static_cast<std::size_t>(at.x());
    const auto y = static_cast<std::size_t>(at.y());
    return 2 * (x * kSide + y) + (roof ? 1 : 0);
  }
  [[nodiscard]] Patch patch(std::size_t number, double z_m) const {
    const auto cell = static_cast<int>(number / 2);
    return {low_.x() + cell / kSide, low_.y() + cell % kSide, number % 2 == 1, z_m};
  }

 private:
  static constexpr int kReach = static_cast<int>(kRangeMaxM / kCellM) + 2;
  static constexpr int kSide = 2 * kReach + 1;

  Eigen::Vector2i low_;
};

/// The returns of a cell.
struct CellHeights {
  std::size_t returns = 0;
  double low_m = std::numeric_limits<double>::infinity();
  double high_m = -std::numeric_limits<double>::infinity();
  std::size_t end = 0;  ///< of its heights, where those of all cells are stored

  [[nodiscard]] bool is_flat() const { return returns >= kReturnsMin && high_m - low_m < kFlatM; }
};

std::vector<CellReturn> returns_around(const CloudStore& clouds, const LeveledScan& scan,
                                       const CellsAround& cells) {
  std::vector<CellReturn> returns;
  for (const CloudLine& line : clouds.lines(scan.cloud)) {
    if (!is_at_place(clouds[scan.cloud], line)) continue;
    for (const Eigen::Vector3f& p_level : line.points) {
      if (!(p_level.head<2>().norm() <= static_cast<float>(kRangeMaxM))) continue;  // NaN too
      const Eigen::Vector3d p = scan.T_survey_level * Eigen::Vector3d(p_level.cast<double>());
      const Eigen::Vector2i cell = cell_of(p.head<2>(), kCellM);
      returns.push_back({cells.number_of(cell, p_level.z() > line.origin.z()), p.z()});
    }
  }
  return returns;
}

/// Floor and roof around a scan, by cells of the plan, sorted: the medians of flat cells.
std::vector<Patch> patches_of(const CloudStore& clouds, const LeveledScan& scan) {
  const CellsAround cells(scan.T_survey_level.translation().head<2>());
  const std::vector<CellReturn> returns = returns_around(clouds, scan, cells);
  std::vector<CellHeights> by_cell(CellsAround::count());
  for (const CellReturn& at : returns) {
    CellHeights& cell = by_cell[at.cell];
    ++cell.returns;
    cell.low_m = std::min(cell.low_m, at.z_m);
    cell.high_m = std::max(cell.high_m, at.z_m);
  }
  std::size_t count = 0;
  for (CellHeights& cell : by_cell) {
    cell.end = count;
    if (cell.is_flat()) count += cell.returns;
  }
  std::vector<double> heights(count);
  for (const CellReturn& at : returns) {
    if (by_cell[at.cell].is_flat()) heights[by_cell[at.cell].end++] = at.z_m;
  }
  std::vector<Patch> patches;
  for (std::size_t i = 0; i < by_cell.size(); ++i) {
    const CellHeights& cell = by_cell[i];
    if (!cell.is_flat()) continue;
    const auto end = heights.begin() + static_cast<std::ptrdiff_t>(cell.end);
    const auto first = end - static_cast<std::ptrdiff_t>(cell.returns);
    const auto middle = first + static_cast<std::ptrdiff_t>(cell.returns / 2);
    std::nth_element(first, middle, end);
    patches.push_back(cells.patch(i, *middle));
  }
  return patches;
}

/// The rotation of one scan against another about the axes of its level frame.
struct RelativeTilt {
  Eigen::Vector2d rotation_rad;
  Eigen::Matrix2d covariance;
};

/// The plane through the differences of heights, as seen from the newer scan.
std::optional<RelativeTilt> relative_tilt(const std::vector<Patch>& older,
                                          const std::vector<Patch>& newer,
                                          const LevelPose& T_survey_newer) {
  const Pose2 T_newer_survey = T_survey_newer.plan.inverse();
  Eigen::Matrix3d A = Eigen::Matrix3d::Zero();
  Eigen::Vector3d b = Eigen::Vector3d::Zero();
  std::size_t cells = 0;
  for (auto a = older.begin(), n = newer.begin(); a != older.end() && n != newer.end();) {
    if (a->key() != n->key()) {
      (a->key() < n->key() ? a : n)++;
      continue;
    }
    const double difference = n->z_m - a->z_m;
    if (std::abs(difference) < kDifferenceMaxM) {
      const Eigen::Vector2d p = T_newer_survey * centre_of({n->x, n->y}, kCellM);
      const Eigen::Vector3d row(p.y(), -p.x(), 1.0);  // rotation about x, about y; height
      A += row * row.transpose();
      b += row * difference;
      ++cells;
    }
    ++a;
    ++n;
  }
  if (cells < kCellsMin) return std::nullopt;
  const Eigen::Matrix3d inverse = A.inverse();
  const Eigen::Matrix3d covariance = kCellsPerSample * kCellSdM * kCellSdM * inverse;
  const Eigen::Vector3d fit = inverse * b;
  return RelativeTilt{fit.head<2>(),
                      covariance.topLeftCorner<2, 2>() +
                          2.0 * kScanSdRad * kScanSdRad * Eigen::Matrix2d::Identity()};
}

}  // namespace

LevelCorrection::LevelCorrection(const CloudStore& clouds, const std::vector<LeveledScan>& scans) {
  std::vector<std::vector<Patch>> patches;
  patches.reserve(scans.size());
  for (const LeveledScan& scan : scans) patches.push_back(patches_of(clouds, scan));
  std::map<int, LevelError> errors;
  for (std::size_t i = 0; i < scans.size(); ++i) {
    LevelError& error = errors.try_emplace(scans[i].session, kPriorSdRad).first->second;
    for (std::size_t k = 0; k < i; ++k) {
      if (scans[k].session != scans[i].session) continue;
      const LevelPose T_older_newer = between(scans[k].T_survey_level, scans[i].T_survey_level);
      const double turn_rad = wrap_angle(T_older_newer.plan.theta);
      if (T_older_newer.translation().norm() > kApartMaxM || std::abs(turn_rad) < kTurnMinRad)
        continue;
      if (const auto tilt = relative_tilt(patches[k], patches[i], scans[i].T_survey_level))
        error.add(turn_rad, tilt->rotation_rad, tilt->covariance);
    }
  }
  for (const auto& [session, error] : errors) {
    const double variance = 0.5 * error.covariance().trace() + kScanSdRad * kScanSdRad;
    sessions_[session] = {error.error_rad(), std::sqrt(variance)};
  }
}

Eigen::Matrix3d LevelCorrection::rotation(int session) const {
  const auto found = sessions_.find(session);
  if (found == sessions_.end()) return Eigen::Matrix3d::Identity();
  const Eigen::Vector2d& about = found->second.rotation_rad;
  return (Eigen::AngleAxisd(about.x(), Eigen::Vector3d::UnitX()) *
          Eigen::AngleAxisd(about.y(), Eigen::Vector3d::UnitY()))
      .toRotationMatrix();
}

double LevelCorrection::sd_rad(int session) const {
  const auto found = sessions_.find(session);
  return found == sessions_.end() ? kPriorSdRad : found->second.sd_rad;
}

}  // namespace adit

// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "procs/planning/lattice/motion_primitives.hpp"

#include <algorithm>
#include <cmath>
#include <set>
#include <stdexcept>

#include "common/types/body_outline.hpp"
#include "procs/planning/c_space/footprint.hpp"
#include "procs/planning/lattice/lattice_symmetry.hpp"

namespace adit {
namespace {

constexpr double kGentleRadiusFactor = 2.5;  // radius of a gentle bend relative to a tight one
constexpr double kBendLengthMaxM = 4.0;
constexpr int kSamplesPerCell = 20;
constexpr double kIntegerTolerance = 1e-9;  // rounding of numbers that are integers
constexpr double kMmPerM = 1000.0;
constexpr double kSampleSpacingM = 0.02;  // twice the margin of swept_kernel()

/// Distance of the point that moves along the x axis of the vehicle behind its origin.
double axle_offset_m(const Vehicle& vehicle) {
  return vehicle.steering == "ackermann" ? vehicle.wheelbase_m / 2.0 : 0.0;
}

/// Minimum radius of the path of that point.
double axle_radius_m(const Vehicle& vehicle, double reserve) {
  const double axle = axle_offset_m(vehicle);
  const double radius = vehicle.turning_radius_m * (1.0 + reserve);
  if (vehicle.turning_radius_m <= axle) {
    throw std::invalid_argument(
        "the turning radius must exceed half the wheelbase with Ackermann steering");
  }
  return std::sqrt(radius * radius - axle * axle);
}

double chebyshev(const SweptPose& a, const SweptPose& b) {
  return std::max(std::abs(a.column - b.column), std::abs(a.row - b.row));
}

double step_cells(const SweptPose& a, const SweptPose& b) {
  return std::hypot(a.column - b.column, a.row - b.row);
}

/// Indices of a short chain of neighbouring cells from the first pose to the last.
std::vector<std::size_t> chain_of(const std::vector<SweptPose>& poses) {
  std::vector<std::size_t> chain{0};
  while (chain.back() + 1 < poses.size()) {
    std::size_t next = chain.back() + 1;
    while (next + 1 < poses.size() && chebyshev(poses[chain.back()], poses[next + 1]) <= 1.0) {
      ++next;
    }
    chain.push_back(next);
  }
  return chain;
}

}  // namespace

MotionPrimitives::MotionPrimitives(const Vehicle& vehicle, const PrimitiveParams& params,
                                   const HeadingSet& headings, double cell_m)
    : headings_(headings),
      cell_m_(cell_m),
      vehicle_(vehicle),
      axle_m_(axle_offset_m(vehicle)),
      radius_min_m_(axle_radius_m(vehicle, params.radius_reserve)),
      from_(static_cast<std::size_t>(headings.count())) {
  const int eighth = headings_.count() / 8;
  const std::set<int> turns{1, std::max(1, eighth / 2), eighth};
  for (int k = 0; k <= eighth; ++k) {
    const bool on_axis = k == 0 || k == eighth;  // left bends are mirrored to right bends there
    const MotionPrimitive shortest = straight(k, 0.0);
    const MotionPrimitive step = straight(k, params.step_m);
    add_with_symmetries(step, on_axis, params);
    if (shortest.cells != step.cells) add_with_symmetries(shortest, on_axis, params);
    for (const int turn : turns) {
      add_bends(k, turn, params);
      if (!on_axis) add_bends(k, -turn, params);
    }
  }
  for (auto& primitives : from_) {
    std::stable_partition(primitives.begin(), primitives.end(),
                          [](const MotionPrimitive& p) { return !p.reverse; });
  }
}

MotionPrimitive MotionPrimitives::straight(int heading, double step_m) const {
  const Eigen::Vector2i& v = headings_.direction(heading);
  const double vector_m = cell_m_ * v.cast<double>().norm();
  const int times = std::max(1, static_cast<int>(std::ceil(step_m / vector_m - 1e-9)));
  MotionPrimitive primitive{heading, heading, v * times};
  primitive.curve.line_in_m = vector_m * times;
  return primitive;
}

MotionPrimitive MotionPrimitives::bend(int heading, int turn, double radius_min_m) const {
  MotionPrimitive best{heading, headings_.wrapped(heading + turn)};
  const double angle_from = headings_.angle(best.from);
  const double turn_rad = angle_diff(headings_.angle(best.to), angle_from);
  const int reach = static_cast<int>(kBendLengthMaxM / cell_m_);
  for (int row = -reach; row <= reach; ++row) {
    for (int column = -reach; column <= reach; ++column) {
      const Eigen::Vector2d p = cell_m_ * Eigen::Vector2d(column, row);
      const Pose2 T_body_end =
          Pose2{0.0, 0.0, angle_from}.inverse() * Pose2{p.x(), p.y(), angle_from + turn_rad};
      const Pose2 axle{-axle_m_, 0.0, 0.0};
      const auto found = line_arc_line_to(axle.inverse() * T_body_end * axle, radius_min_m);
      const double shortest = best.cells.isZero() ? kBendLengthMaxM : best.curve.length_m();
      if (!found || found->length_m() >= shortest - 1e-9) continue;
      best.curve = *found;
      best.cells = {column, row};
    }
  }
  if (best.cells.isZero()) {
    throw std::invalid_argument("the turning radius is too large for the headings of the lattice");
  }
  return best;
}

void MotionPrimitives::add_bends(int heading, int turn, const PrimitiveParams& params) {
  const MotionPrimitive tight = bend(heading, turn, radius_min_m_);
  add_with_symmetries(tight, false, params);
  if (std::abs(turn) != 1) return;
  const MotionPrimitive gentle = bend(heading, turn, kGentleRadiusFactor * radius_min_m_);
  if (gentle.cells != tight.cells) add_with_symmetries(gentle, false, params);
}

MotionPrimitives MotionPrimitives::rear_leading(double reverse_factor) const {
  MotionPrimitives result = *this;
  for (auto& primitives : result.from_) {
    for (MotionPrimitive& primitive : primitives) {
      primitive.length_mm = 0;
      for (SweptPose& pose : primitive.swept) {
        // Lengths in reverse were rounded up: with a factor of at least 1 this inverts exactly.
        const double length_mm =
            primitive.reverse ? std::floor(pose.length_mm / reverse_factor + kIntegerTolerance)
                              : std::ceil(pose.length_mm * reverse_factor - kIntegerTolerance);
        pose.length_mm = static_cast<std::int32_t>(length_mm);
        primitive.length_mm += pose.length_mm;
      }
    }
  }
  return result;
}

int MotionPrimitives::reach() const {
  int reach = 0;
  for (const auto& primitives : from_) {
    for (const MotionPrimitive& p : primitives) {
      reach = std::max({reach, p.body.reach, p.wheels.reach});
    }
  }
  return reach;
}

Pose2 MotionPrimitives::forward_pose(const MotionPrimitive& primitive, double distance_m) const {
  const int heading = primitive.reverse ? primitive.to : primitive.from;
  const Pose2 axle{-axle_m_, 0.0, 0.0};
  return Pose2{0.0, 0.0, headings_.angle(heading)} * axle * primitive.curve.pose_at(distance_m) *
         axle.inverse();
}

Pose2 MotionPrimitives::pose_at(const MotionPrimitive& primitive, double distance_m) const {
  if (!primitive.reverse) return forward_pose(primitive, distance_m);
  const Pose2 pose = forward_pose(primitive, primitive.curve.length_m() - distance_m);
  return {pose.x + cell_m_ * primitive.cells.x(), pose.y + cell_m_ * primitive.cells.y(),
          pose.theta};
}

double MotionPrimitives::curvature_at(const MotionPrimitive& primitive, double distance_m) const {
  const double s_m =
      primitive.reverse ? primitive.curve.length_m() - distance_m - 1e-9 : distance_m;
  const double axle_curvature = primitive.curve.curvature_at(s_m);
  return axle_curvature / std::hypot(1.0, axle_m_ * axle_curvature);
}

void MotionPrimitives::sweep(MotionPrimitive& primitive, double factor) {
  const double length = primitive.curve.length_m();
  const int samples = static_cast<int>(std::ceil(kSamplesPerCell * length / cell_m_));
  std::vector<SweptPose> poses{{0, 0, static_cast<std::uint16_t>(primitive.from), 0}};
  for (int i = 1; i <= samples; ++i) {
    const Pose2 pose = forward_pose(primitive, length * i / samples);
    const SweptPose next{static_cast<std::int16_t>(std::lround(pose.x / cell_m_)),
                         static_cast<std::int16_t>(std::lround(pose.y / cell_m_)),
                         static_cast<std::uint16_t>(headings_.nearest(pose.theta)), 0};
    const SweptPose& last = poses.back();
    if (chebyshev(last, next) > 0.0 || last.heading != next.heading) poses.push_back(next);
  }
  const auto chain = chain_of(poses);
  double cells = 0.0;
  for (std::size_t i = 1; i < chain.size(); ++i) {
    cells += step_cells(poses[chain[i - 1]], poses[chain[i]]);
  }
  length_ratio_min_ = std::min(length_ratio_min_, length / (cells * cell_m_));
  for (std::size_t i = 1; i < chain.size(); ++i) {
    const double share = step_cells(poses[chain[i - 1]], poses[chain[i]]) / cells;
    poses[chain[i]].length_mm =
        static_cast<std::int32_t>(std::ceil(factor * share * length * kMmPerM));
  }
  for (const SweptPose& pose : poses) primitive.length_mm += pose.length_mm;
  primitive.swept.assign(poses.begin() + 1, poses.end());
}

/// Samples poses so densely that no point of the vehicle moves by more than kSampleSpacingM.
void MotionPrimitives::cover(MotionPrimitive& primitive) const {
  const double length = primitive.curve.length_m();
  const double turn = std::abs(primitive.curve.turn_rad);
  const ConvexPolygon outline = body_outline(vehicle_);
  const int samples =
      static_cast<int>(std::ceil((length + outline.radius_m() * turn) / kSampleSpacingM));
  std::vector<Pose2> poses;
  for (int i = 0; i <= samples; ++i) poses.push_back(forward_pose(primitive, length * i / samples));
  primitive.body = swept_kernel({outline}, poses, cell_m_);
  primitive.wheels = swept_kernel(wheel_tracks(vehicle_), poses, cell_m_);
}

void MotionPrimitives::add_with_symmetries(MotionPrimitive primitive, bool is_symmetric,
                                           const PrimitiveParams& params) {
  sweep(primitive, primitive.from == primitive.to ? 1.0 : params.turn_factor);
  cover(primitive);
  for (const LatticeSymmetry& symmetry : lattice_symmetries()) {
    if (is_symmetric && symmetry.mirrored) continue;
    const MotionPrimitive image = symmetry.of(primitive, headings_);
    from_[static_cast<std::size_t>(image.from)].push_back(image);
    const MotionPrimitive reverse = reversed(image, params.reverse_factor);
    from_[static_cast<std::size_t>(reverse.from)].push_back(reverse);
  }
}

}  // namespace adit

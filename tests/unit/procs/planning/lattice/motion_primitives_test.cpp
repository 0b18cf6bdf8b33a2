// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "procs/planning/lattice/motion_primitives.hpp"

#include <algorithm>
#include <cmath>
#include <random>
#include <set>
#include <stdexcept>
#include <string>

#include <gtest/gtest.h>

#include "common/types/body_outline.hpp"
#include "procs/planning/c_space/footprint.hpp"
#include "procs/planning/lattice/lattice_symmetry.hpp"

namespace adit {
namespace {

constexpr double kCellM = 0.1;
constexpr double kRounding = 1e-9;

struct PrimitiveSet {
  std::string steering = "four_wheel";
  int count = 32;

  [[nodiscard]] Vehicle vehicle() const {
    Vehicle with;
    with.steering = steering;
    return with;
  }
};

void PrintTo(const PrimitiveSet& set, std::ostream* os) { *os << set.steering << ' ' << set.count; }

class MotionPrimitiveSets : public testing::TestWithParam<PrimitiveSet> {
 protected:
  Vehicle vehicle_ = GetParam().vehicle();
  HeadingSet headings_{GetParam().count};
  MotionPrimitives primitives_{vehicle_, {}, headings_, kCellM};

  template <class Check>
  void for_each(const Check& check) const {
    for (int k = 0; k < headings_.count(); ++k) {
      for (const MotionPrimitive& primitive : primitives_.from(k)) check(primitive);
    }
  }
};
INSTANTIATE_TEST_SUITE_P(Steering, MotionPrimitiveSets,
                         testing::Values(PrimitiveSet{}, PrimitiveSet{"ackermann"},
                                         PrimitiveSet{"four_wheel", 16},
                                         PrimitiveSet{"ackermann", 16},
                                         PrimitiveSet{"four_wheel", 72}));

TEST_P(MotionPrimitiveSets, StartAndEndExactlyOnTheLattice) {
  for_each([&](const MotionPrimitive& primitive) {
    const Pose2 begin = primitives_.pose_at(primitive, 0.0);
    const Pose2 end = primitives_.pose_at(primitive, primitive.curve.length_m());
    EXPECT_NEAR(begin.translation().norm(), 0.0, kRounding);
    EXPECT_NEAR(angle_diff(begin.theta, headings_.angle(primitive.from)), 0.0, kRounding);
    EXPECT_NEAR((end.translation() - kCellM * primitive.cells.cast<double>()).norm(), 0.0,
                kRounding);
    EXPECT_NEAR(angle_diff(end.theta, headings_.angle(primitive.to)), 0.0, kRounding);
    EXPECT_EQ(primitive.swept.back().column, primitive.cells.x());
    EXPECT_EQ(primitive.swept.back().row, primitive.cells.y());
    EXPECT_EQ(primitive.swept.back().heading, primitive.to);
  });
}

TEST_P(MotionPrimitiveSets, MoveTheSteeredPointAlongTheXAxis) {
  const double axle = vehicle_.steering == "ackermann" ? vehicle_.wheelbase_m / 2.0 : 0.0;
  for_each([&](const MotionPrimitive& primitive) {
    const double step = 1e-5;
    for (double s_m = step; s_m + step < primitive.curve.length_m(); s_m += 0.05) {
      const Pose2 before = primitives_.pose_at(primitive, s_m - step);
      const Pose2 after = primitives_.pose_at(primitive, s_m + step);
      const Pose2 here = primitives_.pose_at(primitive, s_m);
      const Eigen::Vector2d moved =
          after * Eigen::Vector2d(-axle, 0.0) - before * Eigen::Vector2d(-axle, 0.0);
      const Eigen::Vector2d x(std::cos(here.theta), std::sin(here.theta));
      const double sign = primitive.reverse ? -1.0 : 1.0;
      EXPECT_NEAR((moved - sign * 2.0 * step * x).norm(), 0.0, 1e-8);  // arcs bend by step² / R
    }
  });
}

TEST_P(MotionPrimitiveSets, KeepTheReserveOfTheTurningRadius) {
  const double tightest_m = vehicle_.turning_radius_m * (1.0 + PrimitiveParams{}.radius_reserve);
  for_each([&](const MotionPrimitive& primitive) {
    for (double s_m = 0.0; s_m < primitive.curve.length_m(); s_m += 0.01) {
      EXPECT_LE(std::abs(primitives_.curvature_at(primitive, s_m)), 1.0 / tightest_m + kRounding);
    }
  });
}

TEST_P(MotionPrimitiveSets, ChangeTheHeadingInEachBend) {
  for_each([&](const MotionPrimitive& primitive) {
    EXPECT_EQ(primitive.curve.turn_rad != 0.0, primitive.from != primitive.to);
  });
}

TEST_P(MotionPrimitiveSets, ReachAllHeadingsForwards) {
  std::set<int> reached{0};
  for (int round = 0; round < headings_.count(); ++round) {
    for (const int k : std::set<int>(reached)) {
      for (const auto& primitive : primitives_.from(k)) {
        if (!primitive.reverse) reached.insert(primitive.to);
      }
    }
  }
  EXPECT_EQ(reached.size(), static_cast<std::size_t>(headings_.count()));
}

TEST_P(MotionPrimitiveSets, SweepAllPosesInBetween) {
  for_each([&](const MotionPrimitive& primitive) {
    for (double s_m = 0.0; s_m < primitive.curve.length_m(); s_m += 0.013) {
      const Pose2 pose = primitives_.pose_at(primitive, s_m);
      const auto near = [&](double column, double row, int heading) {
        // Poses are sampled at each twentieth of a cell: a corner may be missed by as much.
        const double distance =
            std::max(std::abs(pose.x / kCellM - column), std::abs(pose.y / kCellM - row));
        const double turn = std::abs(angle_diff(pose.theta, headings_.angle(heading)));
        const double half = std::max(headings_.half_gap(heading),
                                     headings_.half_gap(headings_.wrapped(heading - 1)));
        return distance <= 0.5 + 0.05 && turn <= half + 0.01;
      };
      EXPECT_TRUE(near(0, 0, primitive.from) ||
                  std::any_of(primitive.swept.begin(), primitive.swept.end(),
                              [&](const auto& s) { return near(s.column, s.row, s.heading); }));
    }
  });
}

/// Whether a kernel contains the cell of a point.
bool contains(const RunKernel& kernel, const Eigen::Vector2d& p) {
  const auto column = static_cast<int>(std::lround(p.x() / kCellM));
  const auto row = static_cast<int>(std::lround(p.y() / kCellM));
  return std::any_of(kernel.runs.begin(), kernel.runs.end(), [&](const RunKernel::Run& run) {
    return run.row == row && run.first <= column && column <= run.last;
  });
}

/// The point of a rectangle at shares of −1 to 1 of its half length and half width.
Eigen::Vector2d point_of(const ConvexPolygon& rectangle, const Eigen::Vector2d& share) {
  const Eigen::Vector2d middle = 0.5 * (rectangle.low() + rectangle.high());
  return middle + (rectangle.high() - middle).cwiseProduct(share);
}

TEST_P(MotionPrimitiveSets, CoverTheSweptFootprint) {
  const ConvexPolygon body = body_outline(vehicle_);
  std::mt19937 engine(1);
  std::uniform_real_distribution<double> share(-1.0, 1.0);
  for_each([&](const MotionPrimitive& primitive) {
    for (double s_m = 0.0; s_m < primitive.curve.length_m(); s_m += 0.017) {
      const Pose2 pose = primitives_.pose_at(primitive, s_m);
      const Eigen::Vector2d anywhere(share(engine), share(engine));
      ASSERT_TRUE(contains(primitive.body, pose * point_of(body, anywhere)));
      ASSERT_TRUE(contains(primitive.body, pose * body.high()));
      for (const ConvexPolygon& track : wheel_tracks(vehicle_)) {
        ASSERT_TRUE(contains(primitive.wheels, pose * track.high()));
        ASSERT_TRUE(contains(primitive.wheels, pose * point_of(track, anywhere)));
      }
    }
  });
}

TEST_P(MotionPrimitiveSets, CoverAtMostACellBesideTheFootprint) {
  for_each([&](const MotionPrimitive& primitive) {
    if (primitive.from != primitive.to) return;
    const Pose2 T_grid_body{0.0, 0.0, headings_.angle(primitive.from)};
    const double most = vehicle_.width_m / 2.0 + 0.02 + kCellM * std::sqrt(0.5);
    for (const RunKernel::Run& run : primitive.body.runs) {
      for (const int column : {run.first, run.last}) {
        const Eigen::Vector2d p =
            T_grid_body.inverse() * (kCellM * Eigen::Vector2d(column, run.row));
        EXPECT_LT(std::abs(p.y()), most);
      }
    }
  });
}

TEST_P(MotionPrimitiveSets, AreMirrorSymmetric) {
  const LatticeSymmetry mirror{true, 0};
  for_each([&](const MotionPrimitive& primitive) {
    const MotionPrimitive image = mirror.of(primitive, headings_);
    const auto& there = primitives_.from(image.from);
    EXPECT_EQ(std::count_if(there.begin(), there.end(),
                            [&](const MotionPrimitive& p) {
                              return p.to == image.to && p.cells == image.cells &&
                                     p.reverse == image.reverse && p.length_mm == image.length_mm;
                            }),
              1);
  });
}

TEST(MotionPrimitives, RejectARadiusOfLessThanHalfTheWheelbaseWithAckermannSteering) {
  Vehicle vehicle;
  vehicle.steering = "ackermann";
  vehicle.turning_radius_m = 0.7;
  EXPECT_THROW(MotionPrimitives(vehicle, {}, HeadingSet(32), kCellM), std::invalid_argument);
}

}  // namespace
}  // namespace adit

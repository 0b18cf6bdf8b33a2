// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "procs/terrain/memory/height_plane.hpp"

#include "common/geometry/symmetric_solve.hpp"

namespace adit {
namespace {

Eigen::Vector2d regularized_grade(Eigen::Matrix2d moments, const Eigen::Vector2d& heights,
                                  std::size_t count, double spread_m) {
  moments.diagonal().array() += spread_m * spread_m * static_cast<double>(count);
  return solve_symmetric(moments, heights);
}

}  // namespace

void HeightPlaneFit::add(const Eigen::Vector2f& p, float z_m) {
  const Eigen::Vector2d at = p.cast<double>();
  ++count_;
  sum_p_ += at;
  sum_z_ += z_m;
  sum_pp_ += at * at.transpose();
  sum_pz_ += at * static_cast<double>(z_m);
}

HeightPlane HeightPlaneFit::plane(double spread_m) const {
  const auto n = static_cast<double>(count_);
  const Eigen::Vector2d mean = sum_p_ / n;
  const double mean_z = sum_z_ / n;
  const Eigen::Vector2d grade = regularized_grade(sum_pp_ - n * mean * mean.transpose(),
                                                  sum_pz_ - n * mean_z * mean, count_, spread_m);
  return {static_cast<float>(mean_z - grade.dot(mean)), grade.cast<float>()};
}

HeightPlane HeightPlaneFit::plane_through(float z_origin_m, double spread_m) const {
  const auto z = static_cast<double>(z_origin_m);
  const Eigen::Vector2d grade = regularized_grade(sum_pp_, sum_pz_ - z * sum_p_, count_, spread_m);
  return {z_origin_m, grade.cast<float>()};
}

}  // namespace adit

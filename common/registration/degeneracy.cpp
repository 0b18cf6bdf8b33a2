// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "common/registration/degeneracy.hpp"

#include <algorithm>

#include "common/geometry/symmetric_eigen.hpp"

namespace adit {

ConstrainedInformation split_degenerate(const Eigen::Matrix3d& information,
                                        const Eigen::Matrix3d& spurious, double lever_arm_m,
                                        const DegeneracyParams& params) {
  const Eigen::Vector3d to_radians(1.0, 1.0, 1.0 / lever_arm_m);
  const Eigen::Vector3d to_metres(1.0, 1.0, lever_arm_m);
  const auto in_metres = [&](const Eigen::Matrix3d& M) -> Eigen::Matrix3d {
    return to_radians.asDiagonal() * M * to_radians.asDiagonal();
  };
  const SymmetricEigen<3> principal = symmetric_eigen(in_metres(information));
  const Eigen::Matrix3d spurious_m = in_metres(spurious);
  const double least = 1.0 / (params.sd_max_m * params.sd_max_m);

  ConstrainedInformation result;
  for (int i = 0; i < 3; ++i) {
    const Eigen::Vector3d v = principal.vectors.col(i);
    const double information_i = principal.values[i];
    const double spurious_i = v.dot(spurious_m * v);
    if (information_i <= std::max(least, params.spurious_ratio * spurious_i)) {
      result.degenerate.push_back({v, std::max(0.0, information_i - 2.0 * spurious_i)});
    } else {
      const Eigen::Vector3d w = to_metres.asDiagonal() * v;
      const Eigen::Vector3d u = to_radians.asDiagonal() * v;
      result.information += information_i * w * w.transpose();
      result.covariance += u * u.transpose() / information_i;
    }
  }
  return result;
}

}  // namespace adit

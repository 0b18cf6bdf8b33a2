// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

namespace adit {

/// A smooth curve through points, that rises where they rise and falls where they fall: cubic
/// Hermite with the slopes of Fritsch and Butland ("A method for constructing local monotone
/// piecewise cubic interpolants", 1984), level at its ends and beyond them.
class HeightProfile {
 public:
  /// `profile_m` is s, z, s, z, .. Throws std::invalid_argument for an odd list, where s does
  /// not ascend, and for heights that no mine has. Zero everywhere for none.
  explicit HeightProfile(const std::vector<double>& profile_m);

  [[nodiscard]] double at(double s_m) const;

 private:
  struct Knot {
    double s_m = 0.0;
    double z_m = 0.0;
    double slope = 0.0;
  };
  void set_slopes();

  std::vector<Knot> knots_;
};

}  // namespace adit

// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

namespace adit {

/// A curve through points, level beyond its ends: smooth and monotonicity-preserving, by cubic
/// Hermite interpolation with the slopes of Fritsch and Butland ("A method for constructing local
/// monotone piecewise cubic interpolants", 1984) and slope 0 at its ends, or linear.
class HeightProfile {
 public:
  enum class Grade { kSmooth, kSudden };
  /// The value of a key `grade`.
  static Grade grade_named(const std::string& name) {
    return name == "sudden" ? Grade::kSudden : Grade::kSmooth;
  }

  /// `profile_m` is s, z, s, z, ..; empty gives 0 everywhere. Throws std::invalid_argument, which
  /// begins with `what`, for an odd list, for s that does not ascend, and for heights beyond 5000
  /// m.
  explicit HeightProfile(const std::vector<double>& profile_m, Grade grade = Grade::kSmooth,
                         const std::string& what = "heights: profile_m");

  [[nodiscard]] double at(double s_m) const;

 private:
  struct Knot {
    double s_m = 0.0;
    double z_m = 0.0;
    double slope = 0.0;
  };
  void set_slopes();

  Grade grade_;
  std::vector<Knot> knots_;
};

}  // namespace adit

// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>

#include "procs/planning/lattice/motion_primitives.hpp"

namespace adit {

/// A symmetry of the lattice: an optional reflection about the x axis, then rotation by quarter
/// turns.
struct LatticeSymmetry {
  bool mirrored = false;
  int quarters = 0;

  [[nodiscard]] Eigen::Vector2i of(const Eigen::Vector2i& cells) const;
  [[nodiscard]] int of(int heading, const HeadingSet& headings) const;
  [[nodiscard]] MotionPrimitive of(const MotionPrimitive& primitive,
                                   const HeadingSet& headings) const;
};

/// The eight symmetries, the identity first.
std::array<LatticeSymmetry, 8> lattice_symmetries();

/// A primitive driven backwards from its end to its start; its lengths are multiplied by
/// `length_factor`.
MotionPrimitive reversed(const MotionPrimitive& primitive, double length_factor);

}  // namespace adit

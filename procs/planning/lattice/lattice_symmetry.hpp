// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>

#include "procs/planning/lattice/motion_primitives.hpp"

namespace adit {

/// Takes the lattice onto itself: mirrored about x first, or not, then turned by right angles.
struct LatticeSymmetry {
  bool mirrored = false;
  int quarters = 0;

  [[nodiscard]] Eigen::Vector2i of(const Eigen::Vector2i& cells) const;
  [[nodiscard]] int of(int heading, const HeadingSet& headings) const;
  [[nodiscard]] MotionPrimitive of(const MotionPrimitive& primitive,
                                   const HeadingSet& headings) const;
};

/// All eight.
std::array<LatticeSymmetry, 8> lattice_symmetries();

/// A primitive driven the other way, from its end to its beginning.
MotionPrimitive reversed(const MotionPrimitive& primitive, double length_factor);

}  // namespace adit

// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "procs/planning/lattice/lattice_symmetry.hpp"

#include <algorithm>
#include <cmath>
#include <set>
#include <utility>

namespace adit {

Eigen::Vector2i LatticeSymmetry::of(const Eigen::Vector2i& cells) const {
  Eigen::Vector2i image(cells.x(), mirrored ? -cells.y() : cells.y());
  for (int i = 0; i < quarters; ++i) image = {-image.y(), image.x()};
  return image;
}

int LatticeSymmetry::of(int heading, const HeadingSet& headings) const {
  return headings.wrapped((mirrored ? -heading : heading) + quarters * headings.count() / 4);
}

namespace {

/// The image of a kernel under a map of cells to cells.
template <class Image>
RunKernel image_of(const RunKernel& kernel, const Image& image) {
  std::set<std::pair<int, int>> cells;
  int reach = 0;
  for (const RunKernel::Run& run : kernel.runs) {
    for (int column = run.first; column <= run.last; ++column) {
      const Eigen::Vector2i cell = image(Eigen::Vector2i(column, run.row));
      cells.emplace(cell.x(), cell.y());
      reach = std::max(reach, cell.cwiseAbs().maxCoeff());
    }
  }
  return kernel_of(reach, [&](int column, int row) { return cells.count({column, row}) != 0; });
}

}  // namespace

MotionPrimitive LatticeSymmetry::of(const MotionPrimitive& primitive,
                                    const HeadingSet& headings) const {
  MotionPrimitive image = primitive;
  image.from = of(primitive.from, headings);
  image.to = of(primitive.to, headings);
  image.cells = of(primitive.cells);
  if (mirrored) image.curve.turn_rad = -primitive.curve.turn_rad;
  for (SweptPose& pose : image.swept) {
    const Eigen::Vector2i cell = of(Eigen::Vector2i(pose.column, pose.row));
    pose.column = static_cast<std::int16_t>(cell.x());
    pose.row = static_cast<std::int16_t>(cell.y());
    pose.heading = static_cast<std::uint16_t>(of(pose.heading, headings));
  }
  const auto image_cell = [&](const Eigen::Vector2i& cell) { return of(cell); };
  image.body = image_of(primitive.body, image_cell);
  image.wheels = image_of(primitive.wheels, image_cell);
  return image;
}

std::array<LatticeSymmetry, 8> lattice_symmetries() {
  std::array<LatticeSymmetry, 8> all;
  for (std::size_t i = 0; i < all.size(); ++i) all[i] = {i >= 4, static_cast<int>(i % 4)};
  return all;
}

MotionPrimitive reversed(const MotionPrimitive& primitive, double length_factor) {
  MotionPrimitive reverse = primitive;
  reverse.from = primitive.to;
  reverse.to = primitive.from;
  reverse.cells = -primitive.cells;
  reverse.reverse = true;
  reverse.swept.clear();
  reverse.length_mm = 0;
  std::int32_t length_mm = primitive.swept.back().length_mm;
  for (std::size_t i = primitive.swept.size(); i-- > 0;) {
    // The predecessor of pose i; the start of the primitive is not among the swept poses.
    const bool first = i == 0;
    SweptPose pose = first ? SweptPose{0, 0, static_cast<std::uint16_t>(primitive.from), 0}
                           : primitive.swept[i - 1];
    pose.column = static_cast<std::int16_t>(pose.column - primitive.cells.x());
    pose.row = static_cast<std::int16_t>(pose.row - primitive.cells.y());
    // Only poses of the chain (MotionPrimitives::sweep) have a length.
    if (first || pose.length_mm > 0) {
      const auto driven_mm = static_cast<std::int32_t>(std::ceil(length_factor * length_mm));
      length_mm = pose.length_mm;
      pose.length_mm = driven_mm;
      reverse.length_mm += driven_mm;
    }
    reverse.swept.push_back(pose);
  }
  const auto relative_to_end = [&](const Eigen::Vector2i& cell) {
    return Eigen::Vector2i(cell - primitive.cells);
  };
  reverse.body = image_of(primitive.body, relative_to_end);
  reverse.wheels = image_of(primitive.wheels, relative_to_end);
  return reverse;
}

}  // namespace adit

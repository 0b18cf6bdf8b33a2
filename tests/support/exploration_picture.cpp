// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "tests/support/exploration_picture.hpp"

#include <utility>

namespace adit {
namespace {

using Ground = ExplorationPicture::Ground;

/// The box of what was seen.
CellBox observed_box(const Grid2<Occupancy>& known) {
  CellBox box{known.box().to, known.box().from};
  for (std::size_t i = 0; i < known.size(); ++i) {
    if (known[i] == Occupancy::kUnseen) continue;
    box.from = box.from.cwiseMin(known.cell(i));
    box.to = box.to.cwiseMax(known.cell(i) + Eigen::Vector2i(1, 1));
  }
  return box.empty() ? CellBox{{0, 0}, {1, 1}} : box;
}

Ground ground_at(const DrivableSpace& space, const Eigen::Vector2i& cell) {
  const Occupancy known = space.known.get(cell, Occupancy::kUnseen);
  if (known == Occupancy::kUnseen) return Ground::kUnseen;
  if (known == Occupancy::kWall) return Ground::kWall;
  return space.access.get(cell) == Access::kReachable ? Ground::kDrivable : Ground::kFree;
}

}  // namespace

ExplorationPicture exploration_picture(const std::string& title, const Exploration& exploration,
                                       std::vector<Eigen::Vector2d> traversed_path) {
  const DrivableSpace& space = exploration.space();
  const Grid2<Ground> cells(observed_box(space.known));
  ExplorationPicture picture;
  picture.title = title;
  picture.cell_m = space.resolution_m;
  picture.p_map_corner = space.resolution_m * cells.box().from.cast<double>();
  picture.columns = cells.box().size().x();
  for (std::size_t i = 0; i < cells.size(); ++i) {
    picture.cells.push_back(ground_at(space, cells.cell(i)));
  }
  picture.report = exploration.report();
  picture.traversed_path = std::move(traversed_path);
  return picture;
}

}  // namespace adit

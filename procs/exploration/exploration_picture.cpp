// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "procs/exploration/exploration_picture.hpp"

#include <utility>

namespace adit {
namespace {

using Ground = ExplorationPicture::Ground;

/// The box of what was seen.
CellBox seen_box(const CellField<Known>& known) {
  CellBox box{known.box().to, known.box().from};
  for (std::size_t i = 0; i < known.size(); ++i) {
    if (known[i] == Known::kUnseen) continue;
    box.from = box.from.cwiseMin(known.cell(i));
    box.to = box.to.cwiseMax(known.cell(i) + Eigen::Vector2i(1, 1));
  }
  return box.empty() ? CellBox{{0, 0}, {1, 1}} : box;
}

Ground ground_at(const DrivableSpace& space, const Eigen::Vector2i& cell) {
  const Known known = space.known.get(cell, Known::kUnseen);
  if (known == Known::kUnseen) return Ground::kUnseen;
  if (known == Known::kWall) return Ground::kWall;
  return space.access.get(cell) == Access::kReachable ? Ground::kDrivable : Ground::kFree;
}

}  // namespace

ExplorationPicture exploration_picture(const std::string& title, const Exploration& exploration,
                                       std::vector<Eigen::Vector2d> way) {
  const DrivableSpace& space = exploration.space();
  const CellField<Ground> cells(seen_box(space.known));
  ExplorationPicture picture;
  picture.title = title;
  picture.cell_m = space.resolution_m;
  picture.p_map_corner = space.resolution_m * cells.box().from.cast<double>();
  picture.columns = cells.box().size().x();
  for (std::size_t i = 0; i < cells.size(); ++i) {
    picture.cells.push_back(ground_at(space, cells.cell(i)));
  }
  picture.report = exploration.report();
  picture.way = std::move(way);
  return picture;
}

}  // namespace adit

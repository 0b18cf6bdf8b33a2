// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "procs/exploration/map/corridor_width.hpp"

#include <cstddef>
#include <utility>

#include "common/geometry/order_statistics.hpp"
#include "common/geometry/polyline.hpp"

namespace adit {
namespace {

constexpr double kEveryM = 0.5;      // between the places where a line is measured
constexpr double kDirectionM = 1.0;  // to either side, over which the direction is taken
constexpr double kToWallMaxM = 15.0;
constexpr double kUnseenShareMax = 0.25;  // of the cells around what stands free

/// Connected cells of wall.
struct WallPart {
  std::vector<std::size_t> cells;
  std::size_t beside_free = 0;  ///< contacts of its cells with observed space
  std::size_t beside_unseen = 0;
  CellBox box;
};

WallPart wall_part_at(std::size_t first, const Grid2<Occupancy>& known,
                      Grid2<std::uint8_t>& visited) {
  WallPart part;
  part.cells = {first};
  visited[first] = 1;
  const auto around = known.around();
  for (std::size_t i = 0; i < part.cells.size(); ++i) {
    const std::size_t at = part.cells[i];
    part.box = united(part.box, known.cell(at));
    for (const std::ptrdiff_t step : around) {
      const std::size_t next = at + static_cast<std::size_t>(step);
      if (known[next] == Occupancy::kUnseen) ++part.beside_unseen;
      if (known[next] == Occupancy::kFree || known[next] == Occupancy::kDriven) ++part.beside_free;
      if (known[next] != Occupancy::kWall || visited[next] != 0) continue;
      visited[next] = 1;
      part.cells.push_back(next);
    }
  }
  return part;
}

bool stands_free(const WallPart& part, double resolution_m) {
  if (resolution_m * part.box.size().maxCoeff() > CorridorWidth::kStandsFreeMaxM + 1e-9)
    return false;
  const auto contacts = static_cast<double>(part.beside_free + part.beside_unseen);
  return static_cast<double>(part.beside_unseen) <= kUnseenShareMax * contacts;
}

}  // namespace

CorridorWidth::CorridorWidth(const DrivableSpace& space)
    : space_(space), walls_(space.known.box()) {
  const Grid2<Occupancy>& known = space.known;
  Grid2<std::uint8_t> visited(known.box());
  for (std::size_t i = 0; i < known.size(); ++i) {
    if (known[i] != Occupancy::kWall || visited[i] != 0) continue;
    const WallPart part = wall_part_at(i, known, visited);
    if (stands_free(part, space.resolution_m)) continue;
    for (const std::size_t cell : part.cells) walls_[cell] = 1;
  }
}

/// The distance to the middle of the first cell of wall.
std::optional<double> CorridorWidth::to_wall(const Eigen::Vector2d& p,
                                             const Eigen::Vector2d& direction) const {
  const double step = space_.resolution_m / 4.0;
  for (double distance = 0.0; distance <= kToWallMaxM; distance += step) {
    const Eigen::Vector2i cell = space_.cell_at(p + distance * direction);
    if (!walls_.box().contains(cell)) return std::nullopt;
    const std::size_t i = walls_.index(cell);
    if (walls_[i] != 0) return (space_.middle(i) - p).dot(direction);
    if (space_.known[i] == Occupancy::kUnseen) return std::nullopt;
  }
  return std::nullopt;
}

std::optional<double> CorridorWidth::of(const std::vector<Eigen::Vector2d>& points) const {
  if (points.size() < 2) return std::nullopt;
  const Polyline course(points);
  std::vector<double> widths_m;
  for (double at = kEveryM / 2.0; at < course.length_m(); at += kEveryM) {
    const Eigen::Vector2d along = course.chord_at(at, kDirectionM);
    if (along.norm() < space_.resolution_m) continue;
    const Eigen::Vector2d left = Eigen::Vector2d(-along.y(), along.x()).normalized();
    const auto to_left = to_wall(course.at(at), left);
    const auto to_right = to_wall(course.at(at), -left);
    if (to_left && to_right) widths_m.push_back(*to_left + *to_right);
  }
  if (widths_m.empty()) return std::nullopt;
  return median(std::move(widths_m));
}

}  // namespace adit

// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "procs/terrain/unseen_ground.hpp"

#include <cmath>
#include <limits>
#include <vector>

#include "procs/terrain/sight_lines.hpp"

namespace adit {
namespace {

constexpr float kOnePlace = 0.25F;  // in which a tilting laser stays [m]

/// Lines by the place that they look from, in the order of the cloud.
std::vector<std::vector<const CloudLine*>> by_place(const Cloud& cloud) {
  std::vector<std::vector<const CloudLine*>> places;
  for (const CloudLine& line : cloud.lines) {
    if (!is_usable(line.origin)) continue;
    auto place = places.begin();
    while (place != places.end() && (place->front()->origin - line.origin).norm() > kOnePlace) {
      ++place;
    }
    if (place == places.end()) place = places.insert(place, std::vector<const CloudLine*>{});
    place->push_back(&line);
  }
  return places;
}

int knowledge(Ground ground) {
  switch (ground) {
    case Ground::kSeen:
      return 4;
    case Ground::kNoReturn:
      return 3;
    case Ground::kBelowRay:
      return 2;
    case Ground::kShadow:
      return 1;
    case Ground::kNeverSeen:
      break;
  }
  return 0;
}

bool knows_more(const SeenThrough& sighting, const TerrainCell& cell) {
  if (sighting.ground == Ground::kBelowRay && cell.ground == Ground::kBelowRay) {
    return sighting.height_m < cell.low_m;
  }
  return knowledge(sighting.ground) > knowledge(cell.ground);
}

/// A region reaches beyond the last points of the ground before a drop, and into what is hidden: a
/// cell without points of its own is no ground where beams pass over it, or do not get to.
bool is_beyond_an_edge(const SeenThrough& sighting, const TerrainCell& cell, float step_max_m) {
  const bool missed = sighting.ground != Ground::kSeen && sighting.ground != Ground::kNeverSeen;
  return missed && cell.ground == Ground::kSeen && cell.high_m - cell.low_m < step_max_m;
}

void apply(const SeenThrough& sighting, TerrainCell& cell, float step_max_m) {
  if (!knows_more(sighting, cell) && !is_beyond_an_edge(sighting, cell, step_max_m)) return;
  cell.ground = sighting.ground;
  cell.low_m = sighting.height_m;
  cell.high_m = sighting.ground == Ground::kSeen ? sighting.height_m
                                                 : std::numeric_limits<float>::quiet_NaN();
  cell.count = 0;
}

}  // namespace

void tell_unseen_ground_apart(TerrainMap& map, const Cloud& cloud, const CellHeights& heights,
                              const GroundLevel& ground, const TerrainParams& params) {
  const auto step_max_m = static_cast<float>(params.vehicle.step_max_m);
  const BeamEnds ends(map, ground, params);
  for (const auto& lines : by_place(cloud)) {
    const SightLines sight(lines, ends, map, params);
    for (int row = 0; row < map.rows; ++row) {
      for (int column = 0; column < map.columns; ++column) {
        TerrainCell& cell = map.at(column, row);
        if (std::isfinite(heights.lowest_m(column, row)) && cell.ground == Ground::kSeen) continue;
        const Eigen::Vector2f p = map.centre(column, row).cast<float>();
        apply(sight.at(p.x(), p.y()), cell, step_max_m);
      }
    }
  }
}

}  // namespace adit

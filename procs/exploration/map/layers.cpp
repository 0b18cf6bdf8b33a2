// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "procs/exploration/map/layers.hpp"

#include <algorithm>
#include <cmath>
#include <set>
#include <tuple>
#include <utility>

namespace adit {
namespace {

constexpr double kTunnelM = 2.5;  // heights of beams in one tunnel differ by less
constexpr double kSigmas = 3.0;
constexpr int kGapCells = 256;  // between layers in atlas: farther than anything looks ahead

using Ids = std::set<int>;

/// Which local maps observed the same place.
struct Relations {
  std::vector<Ids> above;  ///< by id: those that lie above or below it
  std::vector<Ids> same;   ///< those that observed the same place at the same height
};

/// Both heights follow from one chain, most of whose errors they share: the larger of the variances
/// bounds that of their difference, unless one path is the continuation of the other backwards.
bool differ(double z_a, double z_b, const MapFootprint& a, const MapFootprint& b) {
  const double sd_m = std::sqrt(std::max(a.z_variance, b.z_variance));
  return std::abs(z_a - z_b) > kTunnelM + kSigmas * sd_m;
}

/// A local map and the height of its beams in a coarse cell.
struct Observed {
  Eigen::Vector2i cell;
  int map;
  double z_m;
};

/// Ordered by cell.
std::vector<Observed> observed_cells(const std::vector<MapFootprint>& footprints) {
  std::vector<Observed> observed;
  for (std::size_t i = 0; i < footprints.size(); ++i) {
    for (const Eigen::Vector3d& p : footprints[i].points) {
      observed.push_back({cell_of(p.head<2>(), MapFootprint::kCellM), static_cast<int>(i), p.z()});
    }
  }
  std::ranges::sort(observed, [](const Observed& a, const Observed& b) {
    return std::tuple(a.cell.y(), a.cell.x(), a.map, a.z_m) <
           std::tuple(b.cell.y(), b.cell.x(), b.map, b.z_m);
  });
  return observed;
}

/// Calls `visit(a, b)` for each pair of local maps that observed the same cell, a < b.
template <class Visit>
void for_each_pair(const std::vector<Observed>& observed, const Visit& visit) {
  for (std::size_t i = 0; i < observed.size(); ++i) {
    for (std::size_t k = i + 1; k < observed.size() && observed[k].cell == observed[i].cell; ++k) {
      if (observed[i].map != observed[k].map) visit(observed[i], observed[k]);
    }
  }
}

Relations relations_of(const std::vector<MapFootprint>& footprints,
                       const std::vector<Observed>& observed) {
  Relations relations{std::vector<Ids>(footprints.size()), std::vector<Ids>(footprints.size())};
  const auto at = [](int i) { return static_cast<std::size_t>(i); };
  for_each_pair(observed, [&](const Observed& a, const Observed& b) {
    auto& relation = differ(a.z_m, b.z_m, footprints[at(a.map)], footprints[at(b.map)])
                         ? relations.above
                         : relations.same;
    relation[at(a.map)].insert(b.map);
    relation[at(b.map)].insert(a.map);
  });
  for (std::size_t i = 0; i < footprints.size(); ++i) {
    for (const int other : relations.above[i]) relations.same[i].erase(other);
  }
  return relations;
}

bool is_within_one_tunnel(const std::vector<Observed>& observed) {
  for (std::size_t i = 0; i < observed.size();) {
    double low = observed[i].z_m;
    double high = low;
    const Eigen::Vector2i cell = observed[i].cell;
    for (; i < observed.size() && observed[i].cell == cell; ++i) {
      low = std::min(low, observed[i].z_m);
      high = std::max(high, observed[i].z_m);
    }
    if (high - low > kTunnelM) return false;
  }
  return true;
}

/// Adds one local map after the other.
class Separation {
 public:
  Separation(const std::vector<MapFootprint>& footprints, Relations relations)
      : relations_(std::move(relations)), layers_of_(footprints.size()) {
    for (std::size_t i = 0; i < footprints.size(); ++i) {
      if (footprints[i].points.empty()) {
        layers_of_[i] = {0};
      } else {
        place(static_cast<int>(i));
      }
    }
  }

  [[nodiscard]] std::vector<std::vector<int>> layers() && { return std::move(layers_of_); }

 private:
  [[nodiscard]] std::vector<int>& layers_of(int map) {
    return layers_of_[static_cast<std::size_t>(map)];
  }
  [[nodiscard]] bool is_member(int map, int layer) {
    return std::ranges::count(layers_of(map), layer) > 0;
  }
  [[nodiscard]] bool fits(int map, int layer) const {
    const Ids& above = relations_.above[static_cast<std::size_t>(map)];
    return std::ranges::none_of(members_[static_cast<std::size_t>(layer)],
                                [&](int member) { return above.count(member) > 0; });
  }
  [[nodiscard]] std::vector<int> neighbours_before(int map) const {
    std::vector<int> before;
    for (const int other : relations_.same[static_cast<std::size_t>(map)]) {
      if (other < map) before.push_back(other);
    }
    return before;
  }
  void add(int map, int layer) {
    if (is_member(map, layer)) return;
    layers_of(map).push_back(layer);
    members_[static_cast<std::size_t>(layer)].insert(map);
  }

  /// The first layer of a neighbour in which it shares a layer with all neighbours, else a new one.
  void place(int map) {
    const std::vector<int> neighbours = neighbours_before(map);
    Ids candidates;
    for (const int neighbour : neighbours) candidates.insert(layers_of(neighbour).front());
    if (neighbours.empty() && map > 0) candidates.insert(layers_of(map - 1).front());
    for (const int layer : candidates) {
      if (fits(map, layer) && joins(map, layer, neighbours)) return join(map, layer, neighbours);
    }
    if (members_.size() < kLayersMax) members_.emplace_back();
    join(map, static_cast<int>(members_.size()) - 1, neighbours);
  }

  /// A layer of the neighbour in which the local map fits; -1 if there is none.
  [[nodiscard]] int layer_with(int map, int neighbour) {
    for (const int layer : layers_of(neighbour)) {
      if (fits(map, layer)) return layer;
    }
    return -1;
  }
  [[nodiscard]] bool joins(int map, int layer, const std::vector<int>& neighbours) {
    return std::ranges::all_of(neighbours, [&](int neighbour) {
      return is_member(neighbour, layer) || fits(neighbour, layer) ||
             layer_with(map, neighbour) >= 0;
    });
  }
  void join(int map, int layer, const std::vector<int>& neighbours) {
    add(map, layer);
    for (const int neighbour : neighbours) {
      if (is_member(neighbour, layer)) continue;
      if (fits(neighbour, layer)) {
        add(neighbour, layer);
      } else if (const int other = layer_with(map, neighbour); other >= 0) {
        add(map, other);
      }
    }
  }

  Relations relations_;
  std::vector<std::vector<int>> layers_of_;
  std::vector<Ids> members_;  ///< by layer
};

}  // namespace

std::vector<std::vector<int>> separate_layers(const std::vector<MapFootprint>& footprints) {
  const std::vector<Observed> observed = observed_cells(footprints);
  if (is_within_one_tunnel(observed)) return std::vector<std::vector<int>>(footprints.size(), {0});
  return Separation(footprints, relations_of(footprints, observed)).layers();
}

Atlas::Atlas(const std::vector<CellBox>& boxes, double resolution_m) : resolution_m_(resolution_m) {
  for (std::size_t i = 1; i < boxes.size(); ++i) {
    const int end = boxes[i - 1].to.y() + shift_.back();
    const int steps = (end + kGapCells - boxes[i].from.y() + kGapCells - 1) / kGapCells;
    shift_.push_back(kGapCells * std::max(steps, 1));
    first_row_.push_back(end + kGapCells / 4);
  }
}

int Atlas::layer_of_row(int row) const {
  int layer = 0;
  while (layer + 1 < layers() && row >= first_row_[static_cast<std::size_t>(layer) + 1]) ++layer;
  return layer;
}

int Atlas::layer_of(const Eigen::Vector2d& p_atlas) const {
  return layers() == 1 ? 0 : layer_of_row(cell_of(p_atlas, resolution_m_).y());
}

void SharedCells::add(const Eigen::Vector2i& cell_map, const std::vector<int>& layers) {
  std::uint64_t mask = 0;
  for (const int layer : layers) mask |= std::uint64_t{1} << layer;
  for (const int layer : layers) {
    const Eigen::Vector2i cell = cell_map + Eigen::Vector2i(0, atlas_.shift(layer));
    if (layers_.contains(cell)) layers_.at(cell) |= mask;
  }
}

}  // namespace adit

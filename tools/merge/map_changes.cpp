// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "tools/merge/map_changes.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

namespace adit {
namespace {

// A run takes part in a change if it saw this share of its cells.
constexpr double kShareOfCells = 0.25;

/// A cell of the grid, ordered by row.
struct CellOrder {
  bool operator()(const Eigen::Vector2i& a, const Eigen::Vector2i& b) const {
    return std::pair(a.y(), a.x()) < std::pair(b.y(), b.x());
  }
};

/// The runs that saw a cell as wall, and those that saw it free.
struct Observers {
  std::vector<std::size_t> wall;
  std::vector<std::size_t> free;
};

using ChangedCells = std::map<Eigen::Vector2i, Observers, CellOrder>;

class ChangeSearch {
 public:
  ChangeSearch(const std::vector<OccupancyGrid>& runs, const MapChangesParams& params)
      : runs_(runs), params_(params) {}

  [[nodiscard]] ChangedCells changed_cells() const {
    CellBox box;
    for (const OccupancyGrid& run : runs_) box = united(box, run.observed_box());
    ChangedCells changed;
    for (int y = box.from.y(); y < box.to.y(); ++y) {
      for (int x = box.from.x(); x < box.to.x(); ++x) {
        Observers observers = observers_of({x, y});
        if (!observers.wall.empty() && !observers.free.empty())
          changed.emplace(Eigen::Vector2i(x, y), std::move(observers));
      }
    }
    return changed;
  }

 private:
  [[nodiscard]] Observers observers_of(const Eigen::Vector2i& cell) const {
    Observers observers;
    for (std::size_t i = 0; i < runs_.size(); ++i) {
      if (is_wall(runs_[i], cell)) observers.wall.push_back(i);
    }
    if (observers.wall.empty()) return observers;
    for (std::size_t i = 0; i < runs_.size(); ++i) {
      if (is_free_around(runs_[i], cell)) observers.free.push_back(i);
    }
    return observers;
  }

  [[nodiscard]] bool is_wall(const OccupancyGrid& run, const Eigen::Vector2i& cell) const {
    return run.counts(cell).hits >= params_.hits_min &&
           run.occupancy(cell) >= params_.wall_share_min;
  }

  [[nodiscard]] bool is_free_around(const OccupancyGrid& run, const Eigen::Vector2i& cell) const {
    const int reach = static_cast<int>(std::ceil(params_.clearance_m / run.resolution_m()));
    for (int y = -reach; y <= reach; ++y) {
      for (int x = -reach; x <= reach; ++x) {
        if (x * x + y * y > reach * reach) continue;
        const Eigen::Vector2i near = cell + Eigen::Vector2i(x, y);
        if (run.counts(near).misses < params_.misses_min ||
            run.occupancy(near) > params_.hit_share_max)
          return false;
      }
    }
    return true;
  }

  const std::vector<OccupancyGrid>& runs_;
  const MapChangesParams& params_;
};

/// Takes the cells that are connected with the first one.
ChangedCells take_cluster(ChangedCells& cells, int gap) {
  ChangedCells cluster;
  std::vector<Eigen::Vector2i> next{cells.begin()->first};
  cluster.insert(cells.extract(cells.begin()));
  while (!next.empty()) {
    const Eigen::Vector2i from = next.back();
    next.pop_back();
    for (int y = -gap; y <= gap; ++y) {
      for (int x = -gap; x <= gap; ++x) {
        const Eigen::Vector2i near = from + Eigen::Vector2i(x, y);
        const auto found = cells.find(near);
        if (found == cells.end()) continue;
        next.push_back(near);
        cluster.insert(cells.extract(found));
      }
    }
  }
  return cluster;
}

/// The runs that observed enough of the cells, ascending.
std::vector<std::size_t> observers(const ChangedCells& cells,
                                   std::vector<std::size_t> Observers::*which) {
  std::map<std::size_t, std::size_t> count;
  for (const auto& [cell, seen] : cells) {
    for (const std::size_t run : seen.*which) ++count[run];
  }
  std::vector<std::size_t> runs;
  for (const auto& [run, seen] : count) {
    if (static_cast<double>(seen) >= kShareOfCells * static_cast<double>(cells.size()))
      runs.push_back(run);
  }
  return runs;
}

MapChange::Kind kind_of(const MapChange& change) {
  if (change.wall_runs.empty() || change.free_runs.empty()) return MapChange::Kind::kDiffers;
  if (change.free_runs.back() < change.wall_runs.front()) return MapChange::Kind::kAppeared;
  if (change.wall_runs.back() < change.free_runs.front()) return MapChange::Kind::kVanished;
  return MapChange::Kind::kDiffers;
}

MapChange change_of(const ChangedCells& cluster, double resolution_m) {
  MapChange change;
  CellBox box;
  for (const auto& [cell, seen] : cluster) {
    box = united(box, cell);
    change.cells.emplace_back(resolution_m *
                              (cell.cast<double>() + Eigen::Vector2d::Constant(0.5)));
    change.p_map += change.cells.back() / static_cast<double>(cluster.size());
  }
  change.size_m = resolution_m * box.size().cast<double>();
  change.wall_runs = observers(cluster, &Observers::wall);
  change.free_runs = observers(cluster, &Observers::free);
  change.kind = kind_of(change);
  return change;
}

}  // namespace

std::vector<MapChange> find_changes(const std::vector<OccupancyGrid>& runs,
                                    const MapChangesParams& params) {
  if (runs.size() < 2) return {};
  const double resolution_m = runs.front().resolution_m();
  ChangedCells cells = ChangeSearch(runs, params).changed_cells();
  const int gap = static_cast<int>(std::lround(params.gap_m / resolution_m));
  std::vector<MapChange> changes;
  while (!cells.empty()) {
    MapChange change = change_of(take_cluster(cells, gap), resolution_m);
    if (change.size_m.maxCoeff() >= params.length_min_m) changes.push_back(std::move(change));
  }
  std::ranges::stable_sort(changes, [](const MapChange& a, const MapChange& b) {
    return a.cells.size() > b.cells.size();
  });
  return changes;
}

}  // namespace adit

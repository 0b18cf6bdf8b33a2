// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "tools/merge/merge_files.hpp"

#include <algorithm>
#include <functional>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "common/bus/channels.hpp"
#include "common/files/file_utils.hpp"
#include "common/picture/map_picture.hpp"
#include "procs/mapping/map_journal.hpp"

namespace adit {
namespace {

/// Inserts the scans of the runs that are `wanted`, by their index in the group.
bool insert(const FullMap& map, const RunGroup& group, const std::vector<RunInfo>& runs,
            const std::function<bool(std::size_t)>& wanted, OccupancyGrid& grid) {
  const std::vector<std::size_t> run_of = runs_of_paths(group);
  return map.visit_scans(map, [&](const PlacedScan& placed) {
    const std::size_t run = run_of.at(placed.path);
    if (!wanted(run)) return true;
    const Lasers& lasers = runs[group.runs[run].run].lasers;
    const LaserMount& mount = *placed.channel == channels::kLaserRear ? lasers.rear : lasers.front;
    return grid.insert(*placed.scan, placed.T_map_body * mount.T_body_laser);
  });
}

/// The numbers of runs, from 1.
std::string numbers_text(const std::vector<std::size_t>& placed, const RunGroup& group) {
  std::vector<std::size_t> numbers;
  for (const std::size_t i : placed) numbers.push_back(group.runs[i].run + 1);
  return fmt::format("{}", fmt::join(numbers, ","));
}

MapPicture::Place::Kind place_of(MapChange::Kind kind) {
  switch (kind) {
    case MapChange::Kind::kAppeared:
      return MapPicture::Place::Kind::kAppeared;
    case MapChange::Kind::kVanished:
      return MapPicture::Place::Kind::kVanished;
    case MapChange::Kind::kDiffers:
      break;
  }
  return MapPicture::Place::Kind::kDiffers;
}

bool same_mount(const LaserMount& a, const LaserMount& b) {
  return a.T_body_laser == b.T_body_laser && a.height_m == b.height_m &&
         a.lever_x_m == b.lever_x_m && a.lever_z_m == b.lever_z_m &&
         a.range_min_m == b.range_min_m && a.range_max_m == b.range_max_m;
}

}  // namespace

std::vector<std::size_t> runs_of_paths(const RunGroup& group) {
  std::vector<std::size_t> run_of;
  const LocalMapStore& maps = group.map->local_maps();
  for (std::size_t i = 0; i < maps.size(); ++i) {
    if (i > 0 && maps[i].session == maps[i - 1].session) continue;
    const auto run = std::ranges::find_if(group.runs, [&](const PlacedRun& placed) {
      return static_cast<int>(i) >= placed.first_map &&
             static_cast<int>(i) < placed.first_map + placed.maps;
    });
    run_of.push_back(static_cast<std::size_t>(run - group.runs.begin()));
  }
  return run_of;
}

bool insert_runs(const FullMap& map, const RunGroup& group, const std::vector<RunInfo>& runs,
                 OccupancyGrid& grid) {
  return insert(
      map, group, runs, [](std::size_t) { return true; }, grid);
}

bool insert_run(const FullMap& map, const RunGroup& group, std::size_t placed,
                const std::vector<RunInfo>& runs, OccupancyGrid& grid) {
  return insert(
      map, group, runs, [&](std::size_t run) { return run == placed; }, grid);
}

void write_trajectories(const FullMap& map, const RunGroup& group,
                        const std::filesystem::path& folder) {
  const std::vector<std::size_t> run_of = runs_of_paths(group);
  for (std::size_t i = 0; i < group.runs.size(); ++i) {
    const std::size_t number = group.runs[i].run + 1;
    bool with_heights = false;
    for (std::size_t path = 0; path < run_of.size(); ++path) {
      if (run_of[path] != i) continue;
      for (const TimedPose& pose : map.paths[path]) with_heights |= pose.z_m != 0.0;
    }
    TumWriter writer(folder / fmt::format("trajectory_{}.tum", number), with_heights);
    for (std::size_t path = 0; path < run_of.size(); ++path) {
      if (run_of[path] != i) continue;
      for (const TimedPose& pose : map.paths[path]) writer.add(pose);
    }
    writer.close();
  }
}

void write_changes(const std::vector<MapChange>& changes, const OccupancyGrid& grid,
                   const RunGroup& group, const std::filesystem::path& folder) {
  std::string table = "kind\tx_m\ty_m\twidth_m\theight_m\tcells\twall_runs\tfree_runs\n";
  MapPicture picture;
  picture.title = fmt::format("{} change{} between {} runs", changes.size(),
                              changes.size() == 1 ? "" : "s", group.runs.size());
  for (const MapChange& change : changes) {
    table += fmt::format("{}\t{:.2f}\t{:.2f}\t{:.2f}\t{:.2f}\t{}\t{}\t{}\n", kind_text(change.kind),
                         change.p_map.x(), change.p_map.y(), change.size_m.x(), change.size_m.y(),
                         change.cells.size(), numbers_text(change.wall_runs, group),
                         numbers_text(change.free_runs, group));
    for (const Eigen::Vector2d& cell : change.cells)
      picture.places.push_back({cell, place_of(change.kind)});
  }
  write_text_file(table, folder / "changes.tsv");
  write_map_png(grid, picture, folder / "changes.png");
}

bool write_joined_journal(const RunGroup& group, const std::vector<RunInfo>& runs,
                          const std::filesystem::path& folder) {
  const Lasers& first = runs[group.runs.front().run].lasers;
  const bool same = std::ranges::all_of(group.runs, [&](const PlacedRun& placed) {
    const Lasers& lasers = runs[placed.run].lasers;
    return same_mount(lasers.front, first.front) && same_mount(lasers.rear, first.rear);
  });
  if (!same) return false;
  MapJournal journal(folder / "map.journal");
  const LocalMapStore& maps = group.map->local_maps();
  for (std::size_t i = 0; i < maps.size(); ++i) {
    journal.append(
        MapUpdate{maps.load(i), {}, group.map->cloud_matches(static_cast<int>(i)), true});
  }
  const LazyAssociation& association = group.map->association();
  std::vector<Association> decided;
  for (std::size_t k = 0; k < association.problem().loop_closures.size(); ++k) {
    Association a;
    a.utime = maps.back().end_utime;
    a.loop_closure = association.problem().loop_closures[k];
    a.chosen = association.hypothesis().chosen[k];
    a.reason = "the merged map";
    decided.push_back(std::move(a));
  }
  journal.append(decided);
  return true;
}

const char* kind_text(MapChange::Kind kind) {
  switch (kind) {
    case MapChange::Kind::kAppeared:
      return "appeared";
    case MapChange::Kind::kVanished:
      return "vanished";
    case MapChange::Kind::kDiffers:
      break;
  }
  return "differs";
}

}  // namespace adit

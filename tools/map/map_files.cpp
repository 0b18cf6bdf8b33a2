// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "tools/map/map_files.hpp"

#include <algorithm>
#include <utility>
#include <vector>

#include "common/bus/channels.hpp"
#include "common/grid/map_server.hpp"
#include "common/picture/map_picture.hpp"
#include "tools/eval/tum.hpp"
#include "tools/map/graph_files.hpp"

namespace adit {
namespace {

bool insert_scans(const WholeMap& map, const Lasers& lasers, OccupancyGrid& grid) {
  return std::all_of(map.scans.begin(), map.scans.end(), [&](const PlacedScan& placed) {
    const LaserMount& mount = *placed.channel == channels::kLaserRear ? lasers.rear : lasers.front;
    return grid.insert(*placed.scan, placed.T_map_body * mount.T_body_laser);
  });
}

/// Times at which this run did not observe all of its motion, ascending.
std::vector<std::int64_t> unobserved_times(const RunRecord& record) {
  std::vector<std::int64_t> times;
  for (const ScanMatch& match : record.matches()) {
    if (is_unobserved(match)) times.push_back(match.utime);
  }
  return times;
}

/// The degenerate is marked on the path of this run, the last one.
MapPicture picture_of(const WholeMap& map, const RunRecord& record,
                      const MapFilesOptions& options) {
  MapPicture picture;
  picture.title = options.title;
  const auto unobserved = unobserved_times(record);
  for (const Trajectory& path : map.paths) {
    const bool of_this_run = &path == &map.paths.back();
    if (!picture.path.empty()) picture.jumps.push_back(picture.path.size());
    for (const TimedPose& pose : path) {
      picture.path.push_back(pose.pose);
      picture.degenerate.push_back(
          of_this_run && std::binary_search(unobserved.begin(), unobserved.end(), pose.utime));
    }
  }
  if (options.draw_graph) picture.graph = graph_picture(map);
  return picture;
}

}  // namespace

bool write_map_files(const WholeMap& map, const RunRecord& record, const MapFilesOptions& options,
                     const std::filesystem::path& folder) {
  write_tum(folder / "trajectory.tum", joined_path(map));
  write_tum(folder / "odometry.tum", record.odometry());
  OccupancyGrid grid(options.grid);
  if (!insert_scans(map, options.lasers, grid)) return false;
  write_map_server(grid, folder, "map");
  write_map_png(grid, picture_of(map, record, options), folder / "map.png");
  return true;
}

}  // namespace adit

// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "tools/map/map_files.hpp"

#include <fstream>
#include <stdexcept>

#include "common/bus/channels.hpp"
#include "common/grid/map_server.hpp"
#include "common/picture/map_picture.hpp"
#include "tools/eval/tum.hpp"

namespace adit {
namespace {

void write_trajectory(const Trajectory& trajectory, const std::filesystem::path& path) {
  std::ofstream out(path);
  write_tum(out, trajectory);
  if (!out.flush()) throw std::runtime_error("cannot write " + path.string());
}

bool insert_scans(const RunRecord& record, const ScanMatchingParams& lasers, OccupancyGrid& grid) {
  for (const auto& [scan, match] : record.entries()) {
    if (match.status == ScanMatch::Status::kLost) continue;
    const LaserMount& mount =
        match.channel == channels::kLaserRear ? lasers.laser_rear : lasers.laser_front;
    if (!grid.insert(scan, match.T_odom_body * mount.T_body_laser)) return false;
  }
  return true;
}

MapPicture picture_of(const RunRecord& record, const std::string& title) {
  MapPicture picture;
  picture.title = title;
  for (const auto& [scan, match] : record.entries()) {
    picture.path.push_back(match.T_odom_body);
    picture.degenerate.push_back(!match.degenerate.empty() ||
                                 match.status == ScanMatch::Status::kLost);
  }
  return picture;
}

}  // namespace

bool write_map_files(const RunRecord& record, const ScanMatchingParams& lasers,
                     const OccupancyGridParams& params, const std::string& title,
                     const std::filesystem::path& folder) {
  write_trajectory(record.trajectory(), folder / "trajectory.tum");
  OccupancyGrid grid(params);
  if (!insert_scans(record, lasers, grid)) return false;
  write_map_server(grid, folder, "map");
  write_map_png(grid, picture_of(record, title), folder / "map.png");
  return true;
}

}  // namespace adit

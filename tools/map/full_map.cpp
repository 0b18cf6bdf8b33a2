// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "tools/map/full_map.hpp"

#include <algorithm>
#include <cstddef>
#include <span>
#include <utility>

#include "common/bus/channels.hpp"
#include "tools/map/corrected_trajectory.hpp"

namespace adit {
namespace {

using LocalMaps = std::span<const LocalMap>;

/// The local maps of the session of the first one.
LocalMaps first_session(LocalMaps maps) {
  const auto end = std::find_if(maps.begin(), maps.end(), [&](const LocalMap& map) {
    return map.session != maps.front().session;
  });
  return maps.first(static_cast<std::size_t>(end - maps.begin()));
}

std::vector<MapAnchor> anchors_of(LocalMaps maps, const MapGraph& graph) {
  std::vector<MapAnchor> anchors;
  for (const LocalMap& map : maps) {
    anchors.push_back(
        {map.utime, map.T_odom_local, graph.poses.at(static_cast<std::size_t>(map.id))});
  }
  return anchors;
}

/// T_odom_body at the scans stored in the local maps of one session. Consecutive maps share a scan.
Trajectory stored_odometry(LocalMaps maps) {
  Trajectory odometry;
  for (const LocalMap& map : maps) {
    for (const LocalScan& scan : map.scans) {
      if (!odometry.empty() && scan.scan.utime <= odometry.back().utime) continue;
      odometry.push_back({scan.scan.utime, map.T_odom_local * scan.T_local_body});
    }
  }
  return odometry;
}

void place_scan(const std::string& channel, const LaserScan& scan, const Trajectory& path,
                std::vector<PlacedScan>& placed) {
  if (const auto T_map_body = interpolate(path, scan.utime)) {
    placed.push_back({&channel, &scan, *T_map_body});
  }
}

void add_session(LocalMaps maps, Trajectory path, FullMap& full) {
  for (const LocalMap& map : maps) {
    full.local_maps.push_back(&map);
    for (const LocalScan& scan : map.scans) place_scan(scan.channel, scan.scan, path, full.scans);
  }
  full.paths.push_back(std::move(path));
}

void add_earlier_sessions(LocalMaps maps, FullMap& full) {
  while (!maps.empty()) {
    const LocalMaps session = first_session(maps);
    add_session(session,
                corrected_trajectory(stored_odometry(session), anchors_of(session, full.graph)),
                full);
    maps = maps.subspan(session.size());
  }
}

void add_associations(const std::vector<Association>& associations, FullMap& full) {
  for (const Association& association : associations) full.associations.push_back(&association);
}

}  // namespace

FullMap full_map(const StoredMap& earlier, const RunRecord& record) {
  FullMap full;
  if (record.graph()) full.graph = *record.graph();
  add_earlier_sessions(earlier.maps, full);
  const LocalMaps maps = record.local_maps();
  add_session(maps, corrected_trajectory(record.odometry(), anchors_of(maps, full.graph)), full);
  for (const auto& [scan, match] : record.tail()) {
    place_scan(match.channel, scan, full.paths.back(), full.scans);
  }
  add_associations(earlier.associations, full);
  add_associations(record.associations(), full);
  return full;
}

Trajectory joined_path(const FullMap& map) {
  Trajectory all;
  for (const Trajectory& path : map.paths) all.insert(all.end(), path.begin(), path.end());
  std::stable_sort(all.begin(), all.end(),
                   [](const TimedPose& a, const TimedPose& b) { return a.utime < b.utime; });
  Trajectory joined;
  for (const TimedPose& pose : all) {
    if (!joined.empty() && joined.back().utime == pose.utime) joined.pop_back();
    joined.push_back(pose);
  }
  return joined;
}

bool insert_scans(const FullMap& map, const Lasers& lasers, OccupancyGrid& grid) {
  return std::all_of(map.scans.begin(), map.scans.end(), [&](const PlacedScan& placed) {
    const LaserMount& mount = *placed.channel == channels::kLaserRear ? lasers.rear : lasers.front;
    return grid.insert(*placed.scan, placed.T_map_body * mount.T_body_laser);
  });
}

std::size_t count_cross_session_loop_closures(const FullMap& map) {
  if (map.local_maps.empty()) return 0;
  const auto session_of = [&](int id) {
    return map.local_maps[static_cast<std::size_t>(id)]->session;
  };
  const int last = map.local_maps.back()->session;
  return static_cast<std::size_t>(
      std::count_if(map.graph.constraints.begin(), map.graph.constraints.end(),
                    [&](const MapConstraint& constraint) {
                      return constraint.kind == MapConstraint::Kind::kLoopClosure &&
                             session_of(constraint.measured.to) == last &&
                             session_of(constraint.measured.from) != last;
                    }));
}

}  // namespace adit

// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "tools/map/full_map.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <span>
#include <utility>

#include "common/bus/channels.hpp"

namespace adit {
namespace {

constexpr double kMetresPerRadian = 1.0;

/// Distance travelled up to each pose, rotation included [m].
std::vector<double> progress_of(const Trajectory& odometry) {
  std::vector<double> progress;
  for (std::size_t i = 0; i < odometry.size(); ++i) {
    if (i == 0) {
      progress.push_back(0.0);
      continue;
    }
    const Pose2 step = between(odometry[i - 1].pose, odometry[i].pose);
    progress.push_back(progress.back() + step.translation().norm() +
                       kMetresPerRadian * std::abs(step.theta));
  }
  return progress;
}

/// T_map_body by the correction of one anchor.
Pose2 apply_anchor(const MapAnchor& anchor, const Pose2& T_odom_body) {
  return anchor.T_map_local * between(anchor.T_odom_local, T_odom_body);
}

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
    anchors.push_back(map_anchor(map, graph));
  }
  return anchors;
}

/// T_odom_body at the scans stored in the local maps of one session. Consecutive maps share a scan.
Trajectory stored_odometry(LocalMaps maps) {
  Trajectory odometry;
  for (const LocalMap& map : maps) {
    for (const LocalScan& scan : map.scans) {
      if (!odometry.empty() && scan.scan.utime <= odometry.back().utime) continue;
      odometry.push_back(
          {scan.scan.utime, map.T_odom_local * scan.T_local_body, map.z_odom_m + scan.z_m});
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

MapAnchor map_anchor(const LocalMap& map, const MapGraph& graph) {
  const auto id = static_cast<std::size_t>(map.id);
  const double z_map_m = id < graph.z_m.size() ? graph.z_m[id] : 0.0;
  return {map.utime, map.T_odom_local, graph.poses.at(id), z_map_m - map.z_odom_m};
}

Trajectory corrected_trajectory(const Trajectory& odometry, const std::vector<MapAnchor>& anchors) {
  if (anchors.empty() || odometry.empty()) return odometry;
  const std::vector<double> progress = progress_of(odometry);
  const auto progress_at = [&](std::int64_t utime) {
    const auto pose =
        std::lower_bound(odometry.begin(), odometry.end(), utime,
                         [](const TimedPose& p, std::int64_t t) { return p.utime < t; });
    const auto last = odometry.end() - 1;
    return progress[static_cast<std::size_t>(std::min(pose, last) - odometry.begin())];
  };

  Trajectory corrected;
  std::size_t k = 0;  // last anchor at or before the pose
  for (std::size_t i = 0; i < odometry.size(); ++i) {
    const auto& [utime, T_odom_body, z_odom_m] = odometry[i];
    while (k + 1 < anchors.size() && anchors[k + 1].utime <= utime) ++k;
    Pose2 T_map_body = apply_anchor(anchors[k], T_odom_body);
    double z_map_odom_m = anchors[k].z_map_odom_m;
    if (k + 1 < anchors.size() && utime > anchors[k].utime) {
      const double from = progress_at(anchors[k].utime);
      const double length = progress_at(anchors[k + 1].utime) - from;
      const double share = length > 0.0 ? (progress[i] - from) / length : 0.0;
      T_map_body = blend(T_map_body, apply_anchor(anchors[k + 1], T_odom_body), share);
      z_map_odom_m = std::lerp(z_map_odom_m, anchors[k + 1].z_map_odom_m, share);
    }
    corrected.push_back({utime, T_map_body, z_odom_m + z_map_odom_m});
  }
  return corrected;
}

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

// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "tools/map/full_map.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <optional>
#include <utility>

#include "common/bus/channels.hpp"

namespace adit {
namespace {

constexpr double kMetresPerRadian = 1.0;

/// Distance travelled up to the poses that are added, rotation included [m].
class Progress {
 public:
  double add(const Pose2& pose) {
    if (last_) {
      const Pose2 step = between(*last_, pose);
      travelled_m_ += step.translation().norm() + kMetresPerRadian * std::abs(step.theta);
    }
    last_ = pose;
    return travelled_m_;
  }

 private:
  std::optional<Pose2> last_;
  double travelled_m_ = 0.0;
};

/// The progress at the time of each anchor, of which the poses are in order of time.
template <class Poses>
std::vector<double> progress_at(const std::vector<MapAnchor>& anchors, const Poses& odometry) {
  std::vector<double> at;
  Progress progress;
  double travelled_m = 0.0;
  for (const TimedPose& pose : odometry) {
    travelled_m = progress.add(pose.pose);
    while (at.size() < anchors.size() && anchors[at.size()].utime <= pose.utime) {
      at.push_back(travelled_m);
    }
  }
  at.resize(anchors.size(), travelled_m);
  return at;
}

/// T_map_body by the correction of one anchor.
Pose2 apply_anchor(const MapAnchor& anchor, const Pose2& T_odom_body) {
  return anchor.T_map_local * between(anchor.T_odom_local, T_odom_body);
}

/// Passes the corrected poses to `use`, in order.
template <class Poses, class Use>
void correct(const Poses& odometry, const std::vector<MapAnchor>& anchors, const Use& use) {
  if (anchors.empty()) {
    for (const TimedPose& pose : odometry) use(pose);
    return;
  }
  const std::vector<double> anchored_m = progress_at(anchors, odometry);
  Progress progress;
  std::size_t k = 0;  // last anchor at or before the pose
  for (const TimedPose& at : odometry) {
    const double travelled_m = progress.add(at.pose);
    while (k + 1 < anchors.size() && anchors[k + 1].utime <= at.utime) ++k;
    Pose2 T_map_body = apply_anchor(anchors[k], at.pose);
    double z_map_odom_m = anchors[k].z_map_odom_m;
    if (k + 1 < anchors.size() && at.utime > anchors[k].utime) {
      const double from = anchored_m[k];
      const double length = anchored_m[k + 1] - from;
      const double share = length > 0.0 ? (travelled_m - from) / length : 0.0;
      T_map_body = blend(T_map_body, apply_anchor(anchors[k + 1], at.pose), share);
      z_map_odom_m = std::lerp(z_map_odom_m, anchors[k + 1].z_map_odom_m, share);
    }
    use(TimedPose{at.utime, T_map_body, at.z_m + z_map_odom_m});
  }
}

/// Some of the local maps of a store, which have consecutive ids.
struct MapRange {
  const LocalMapStore* store = nullptr;
  std::size_t begin = 0;
  std::size_t end = 0;
};

/// One for each session.
std::vector<MapRange> sessions_of(const LocalMapStore& store) {
  std::vector<MapRange> sessions;
  for (std::size_t i = 0; i < store.size(); ++i) {
    if (i == 0 || store[i].session != store[i - 1].session) sessions.push_back({&store, i, i});
    sessions.back().end = i + 1;
  }
  return sessions;
}

std::vector<MapAnchor> anchors_of(const MapRange& maps, const MapGraph& graph) {
  std::vector<MapAnchor> anchors;
  for (std::size_t i = maps.begin; i < maps.end; ++i) {
    anchors.push_back(map_anchor((*maps.store)[i], graph));
  }
  return anchors;
}

/// T_odom_body at the scans stored in the local maps of one session. Consecutive maps share a scan.
Spool<TimedPose> stored_odometry(const MapRange& maps, const std::filesystem::path& scratch) {
  Spool<TimedPose> odometry(scratch);
  std::int64_t last_utime = std::numeric_limits<std::int64_t>::min();
  for (std::size_t i = maps.begin; i < maps.end; ++i) {
    const LocalMap map = maps.store->load(i);
    for (const LocalScan& scan : map.scans) {
      if (scan.scan.utime <= last_utime) continue;
      last_utime = scan.scan.utime;
      odometry.push_back(
          {scan.scan.utime, map.T_odom_local * scan.T_local_body, map.z_odom_m + scan.z_m});
    }
  }
  return odometry;
}

/// True if there is no pose at the time of the scan.
bool use_scan(const std::string& channel, const LaserScan& scan, const FullMap& map,
              std::size_t path, const FullMap::UseScan& use) {
  const auto T_map_body = interpolate(map.paths[path], scan.utime);
  return !T_map_body || use({&channel, &scan, *T_map_body, path});
}

bool use_scans(const MapRange& maps, const FullMap& full, std::size_t path,
               const FullMap::UseScan& use) {
  for (std::size_t i = maps.begin; i < maps.end; ++i) {
    const LocalMap map = maps.store->load(i);
    for (const LocalScan& scan : map.scans) {
      if (!use_scan(scan.channel, scan.scan, full, path, use)) return false;
    }
  }
  return true;
}

void add_maps(const LocalMapStore& store, FullMap& full) {
  for (const LocalMap& map : store.headers()) full.local_maps.push_back(&map);
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
  Trajectory corrected;
  correct(odometry, anchors, [&](const TimedPose& pose) { corrected.push_back(pose); });
  return corrected;
}

Spool<TimedPose> corrected_path(const Spool<TimedPose>& odometry,
                                const std::vector<MapAnchor>& anchors,
                                const std::filesystem::path& scratch) {
  Spool<TimedPose> corrected(scratch);
  correct(odometry, anchors, [&](const TimedPose& pose) { corrected.push_back(pose); });
  return corrected;
}

FullMap full_map(const EarlierMap& earlier, const RunRecord& record,
                 const std::filesystem::path& scratch) {
  FullMap full;
  if (record.graph()) full.graph = *record.graph();
  std::vector<MapRange> sessions = sessions_of(earlier.maps);
  for (const MapRange& session : sessions) {
    full.paths.push_back(corrected_path(stored_odometry(session, scratch),
                                        anchors_of(session, full.graph), scratch));
  }
  const MapRange run{&record.local_maps(), 0, record.local_maps().size()};
  sessions.push_back(run);
  full.paths.push_back(corrected_path(record.odometry(), anchors_of(run, full.graph), scratch));
  add_maps(earlier.maps, full);
  add_maps(record.local_maps(), full);
  add_associations(earlier.associations, full);
  add_associations(record.associations(), full);
  full.visit_scans = [sessions = std::move(sessions), &record](const FullMap& map,
                                                               const FullMap::UseScan& use) {
    for (std::size_t i = 0; i < sessions.size(); ++i) {
      if (!use_scans(sessions[i], map, i, use)) return false;
    }
    return std::ranges::all_of(record.tail(), [&](const RunRecord::Entry& entry) {
      return use_scan(entry.match.channel, entry.scan, map, map.paths.size() - 1, use);
    });
  };
  return full;
}

FullMap full_map(const LocalMapStore& maps, MapGraph graph, const std::filesystem::path& scratch) {
  FullMap full;
  full.graph = std::move(graph);
  const std::vector<MapRange> sessions = sessions_of(maps);
  for (const MapRange& session : sessions) {
    full.paths.push_back(corrected_path(stored_odometry(session, scratch),
                                        anchors_of(session, full.graph), scratch));
  }
  add_maps(maps, full);
  full.visit_scans = [sessions](const FullMap& map, const FullMap::UseScan& use) {
    for (std::size_t i = 0; i < sessions.size(); ++i) {
      if (!use_scans(sessions[i], map, i, use)) return false;
    }
    return true;
  };
  return full;
}

/// Merges the paths; each is in order.
void visit_joined_path(const FullMap& map, const std::function<void(const TimedPose&)>& use) {
  std::vector<std::size_t> next(map.paths.size(), 0);
  std::optional<TimedPose> last;
  while (true) {
    std::optional<TimedPose> earliest;
    std::size_t from = 0;
    for (std::size_t i = 0; i < next.size(); ++i) {
      if (next[i] == map.paths[i].size()) continue;
      const TimedPose pose = map.paths[i][next[i]];
      if (earliest && pose.utime >= earliest->utime) continue;
      earliest = pose;
      from = i;
    }
    if (last && (!earliest || earliest->utime != last->utime)) use(*last);
    if (!earliest) return;
    last = earliest;
    ++next[from];
  }
}

Trajectory joined_path(const FullMap& map) {
  Trajectory joined;
  visit_joined_path(map, [&](const TimedPose& pose) { joined.push_back(pose); });
  return joined;
}

bool insert_scans(const FullMap& map, const Lasers& lasers, OccupancyGrid& grid) {
  return map.visit_scans(map, [&](const PlacedScan& placed) {
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

// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "tools/report/mission_map.hpp"

#include <algorithm>
#include <map>
#include <utility>

namespace adit {
namespace {

/// True for the placeholder of an id that is not in the log.
bool is_missing(const LocalMap& map) { return map.utime == 0; }

/// Local maps indexed by id, `count` of them, with placeholders for missing ones.
std::vector<LocalMap> local_maps_by_id(std::vector<LocalMap> found, std::size_t count) {
  std::vector<LocalMap> maps(count);
  for (std::size_t i = 0; i < count; ++i) maps[i].id = static_cast<int>(i);
  for (LocalMap& map : found) {
    const auto id = static_cast<std::size_t>(map.id);
    if (id < count) maps[id] = std::move(map);
  }
  for (std::size_t i = 1; i < count; ++i) {
    if (is_missing(maps[i])) maps[i].session = maps[i - 1].session;
  }
  return maps;
}

/// Poses in the time interval [from_utime, to_utime).
Trajectory time_slice(const Trajectory& poses, std::int64_t from_utime, std::int64_t to_utime) {
  const auto is_before = [](const TimedPose& pose, std::int64_t utime) {
    return pose.utime < utime;
  };
  return {std::lower_bound(poses.begin(), poses.end(), from_utime, is_before),
          std::lower_bound(poses.begin(), poses.end(), to_utime, is_before)};
}

Spool<TimedPose> spooled(const Trajectory& path) {
  Spool<TimedPose> spool;
  for (const TimedPose& pose : path) spool.push_back(pose);
  return spool;
}

constexpr std::int64_t kNever = 9'000'000'000'000'000'000;

}  // namespace

MissionMap::MissionMap(MapRecord& record) {
  set_graph(record);
  local_maps_ = local_maps_by_id(record.release_local_maps(), full_map_.graph.poses.size());
  for (const LocalMap& map : local_maps_) {
    full_map_.local_maps.push_back(&map);
    if (is_missing(map)) ++missing_;
  }
  for (const Association& association : record.associations()) {
    full_map_.associations.push_back(&association);
  }
  add_sessions(record.odometry());
  full_map_.visit_scans = [this](const FullMap&, const FullMap::UseScan& use) {
    return visit_scans(use);
  };
  path_ = joined_path(full_map_);
}

void MissionMap::set_graph(const MapRecord& record) {
  if (record.graph()) {
    full_map_.graph = *record.graph();
    return;
  }
  for (const auto& [id, map] : record.local_maps()) {  // without a graph, map is odom
    if (static_cast<std::size_t>(id) != full_map_.graph.poses.size()) break;
    full_map_.graph.poses.push_back(map.T_odom_local);
  }
}

/// Each session has its own odom frame, which starts with its first local map.
void MissionMap::add_sessions(const Trajectory& odometry) {
  std::map<int, std::vector<MapAnchor>> anchors;
  for (const LocalMap& map : local_maps_) {
    if (is_missing(map)) continue;
    anchors[map.session].push_back(map_anchor(map, full_map_.graph));
  }
  if (anchors.empty()) full_map_.paths.push_back(spooled(odometry));
  std::int64_t from_utime = 0;
  for (auto session = anchors.begin(); session != anchors.end(); ++session) {
    const auto next = std::next(session);
    const std::int64_t to_utime = next == anchors.end() ? kNever : next->second.front().utime;
    full_map_.paths.push_back(
        spooled(corrected_trajectory(time_slice(odometry, from_utime, to_utime), session->second)));
    from_utime = to_utime;
  }
}

bool MissionMap::visit_scans(const FullMap::UseScan& use) const {
  for (const LocalMap& map : local_maps_) {
    const Pose2& T_map_local = full_map_.graph.poses[static_cast<std::size_t>(map.id)];
    for (const LocalScan& scan : map.scans) {
      if (!use({&scan.channel, &scan.scan, T_map_local * scan.T_local_body})) return false;
    }
  }
  return true;
}

std::optional<Pose2> MissionMap::T_map_body_at(std::int64_t utime) const {
  if (path_.empty()) return std::nullopt;
  return interpolate(path_, std::clamp(utime, path_.front().utime, path_.back().utime));
}

std::optional<OccupancyGrid> MissionMap::grid(const Lasers& lasers) const {
  OccupancyGrid grid{OccupancyGridParams{}};
  if (!insert_scans(full_map_, lasers, grid) || grid.observed_box().empty()) return std::nullopt;
  return grid;
}

}  // namespace adit

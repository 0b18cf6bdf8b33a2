// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "tests/live/checks/mission_losses.hpp"

#include <algorithm>
#include <iterator>
#include <map>
#include <optional>
#include <set>
#include <utility>

#include "common/bus/channels.hpp"
#include "common/bus/log/event_source.hpp"
#include "common/journal/journal.hpp"
#include "common/messages/codec.hpp"
#include "common/messages/mapping/cloud.hpp"
#include "common/messages/mapping/local_map.hpp"
#include "common/messages/mapping/odometry.hpp"
#include "common/messages/mapping/pose_graph.hpp"
#include "procs/mapping/map_journal.hpp"
#include "procs/volume_map/volume_record.hpp"
#include "tests/live/checks/log_check.hpp"

namespace adit::test {
namespace {

/// Collects the published data of the logs of a mission, in order.
class PublishedDataReader {
 public:
  void add_log(const std::filesystem::path& path) {
    const LogFile log(path);
    if (begin_utime_ == 0) begin_utime_ = log.events().front().utime;
    end_utime_ = log.events().back().utime;
    for (const LogEventView& event : log.events()) add_log(event);
  }

  PublishedData take() {
    PublishedData published;
    for (auto& [id, map] : maps_) published.maps.push_back(std::move(map));
    for (const auto& [id, times] : map_times_) published.map_times.push_back(times);
    for (const auto& [id, times] : scans_) published.scans.push_back(times);
    published.graph_nodes = graph_nodes_;
    if (p_world_start_) published.distance_from_start_m = (p_world_body_ - *p_world_start_).norm();
    return published;
  }

 private:
  void add_log(const LogEventView& event) {
    if (event.channel == channels::kLocalMap) {
      auto map = local_maps_.add(value_of<local_map_t>(event));
      if (!map) return;
      map_times_[map->id] = item(map->id, event.utime);
      maps_[map->id] = std::move(*map);
    } else if (event.channel == channels::kCloud) {
      const auto cloud = clouds_.add(value_of<cloud_t>(event));
      if (cloud) scans_[cloud->id] = item(cloud->id, event.utime);
    } else if (event.channel == channels::kPoseGraph) {
      graph_nodes_ = value_of<pose_graph_t>(event).n_nodes;
    } else if (event.channel == channels::kTruth) {
      const auto pose = value_of<pose_t>(event);  // in world: TRUTH
      p_world_body_ = {pose.T_odom_body.x, pose.T_odom_body.y, pose.z_m};
      if (!p_world_start_) p_world_start_ = p_world_body_;
    }
  }

  [[nodiscard]] PublishedItem item(std::int32_t id, std::int64_t utime) const {
    return {id, 1e-6 * static_cast<double>(utime - begin_utime_),
            1e-6 * static_cast<double>(end_utime_ - utime)};
  }

  LocalMapReassembler local_maps_;
  CloudReassembler clouds_;
  std::map<int, LocalMap> maps_;  // by id
  std::map<int, PublishedItem> map_times_;
  std::map<int, PublishedItem> scans_;  // by id
  int graph_nodes_ = 0;
  std::int64_t begin_utime_ = 0;  // of the first log
  std::int64_t end_utime_ = 0;    // of the current log
  std::optional<Eigen::Vector3d> p_world_start_;
  Eigen::Vector3d p_world_body_{0.0, 0.0, 0.0};
};

std::set<std::int32_t> scans_in(const std::filesystem::path& volume_journal) {
  std::set<std::int32_t> ids;
  read_journal(volume_journal, [&](const JournalRecord& record) {
    const auto read = volume_record_from(record.bytes);
    if (!read) return;
    for (const VolumePoint& point : read->volume.contents.points) ids.insert(point.scan);
  });
  return ids;
}

}  // namespace

PublishedData published_in(const std::vector<std::filesystem::path>& logs) {
  PublishedDataReader reader;
  for (const std::filesystem::path& log : logs) {
    if (std::filesystem::file_size(log) > 0) reader.add_log(log);
  }
  return reader.take();
}

MissionLosses losses(const PublishedData& published, const std::filesystem::path& map_journal,
                     const std::filesystem::path& volume_journal) {
  MissionLosses lost;
  const StoredMap stored = read_map_journal(map_journal);
  for (std::size_t i = 0; i < published.maps.size(); ++i) {
    const LocalMap& map = published.maps[i];
    const bool is_stored = std::ranges::find(stored.maps, map) != stored.maps.end();
    if (!is_stored || map.id >= published.graph_nodes) lost.maps.push_back(published.map_times[i]);
  }
  const std::set<std::int32_t> stored_ids = scans_in(volume_journal);
  std::ranges::copy_if(published.scans, std::back_inserter(lost.scans),
                       [&](const PublishedItem& scan) { return !stored_ids.contains(scan.id); });
  return lost;
}

}  // namespace adit::test

// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "procs/volume_map/volume_journal.hpp"

#include <algorithm>
#include <cstdint>
#include <optional>
#include <utility>

#include "common/journal/journal.hpp"
#include "procs/volume_map/volume_record.hpp"

namespace adit {
namespace {

constexpr std::string_view kScan = "VOLUME_SCAN";
constexpr std::string_view kTime = "VOLUME_SCAN_TIME";
constexpr std::string_view kOdom = "VOLUME_ODOM";

/// In memory order, without padding.
struct OdomRecord {
  std::int64_t begin_utime;
  std::int64_t end_utime;
  std::int32_t session;
  std::int32_t local_map;
  double x;
  double y;
  double theta;
  double z_m;
};
static_assert(sizeof(OdomRecord) == 56);

OdomRecord record_of(const AnchoredOdom& odom) {
  const auto& [plan, z_m] = odom.T_local_odom;
  return {odom.begin_utime, odom.end_utime, odom.session, odom.local_map,
          plan.x,           plan.y,         plan.theta,   z_m};
}

AnchoredOdom odom_of(const OdomRecord& record) {
  return {record.begin_utime,
          record.end_utime,
          record.session,
          record.local_map,
          {{record.x, record.y, record.theta}, record.z_m}};
}

}  // namespace

VolumeJournal::VolumeJournal(const std::filesystem::path& path)
    : journal_(path, [this](const JournalRecord& record) { read(record); }) {
  written_times_ = restored_.scan_utimes.size();
  written_odom_ = restored_.odom;
  for (const StoredVolume& volume : restored_.volumes) {
    written_.push_back(
        {volume.contents.scans, volume.contents.points.size(), volume.anchor.has_value(), 0});
  }
}

void VolumeJournal::read(const JournalRecord& record) {
  if (record.kind == kScan) read_volume(record);
  if (record.kind == kTime) {
    const auto utime = value_from_bytes<std::int64_t>(record.bytes);
    if (utime) restored_.scan_utimes.push_back(*utime);
  }
  if (record.kind == kOdom) {
    const auto odom = value_from_bytes<OdomRecord>(record.bytes);
    if (odom) restored_.odom = odom_of(*odom);
  }
}

/// A new sub-volume, a known one with more scans, or its replacement. If the first record of a
/// sub-volume is lost, it is made from the next one, without some of its points.
void VolumeJournal::read_volume(const JournalRecord& record) {
  auto read = volume_record_from(record.bytes);
  if (!read) return;
  std::vector<StoredVolume>& volumes = restored_.volumes;
  const auto id = static_cast<std::size_t>(read->id);
  if (id > volumes.size()) return;
  if (id == volumes.size()) {
    volumes.push_back(std::move(read->volume));
    return;
  }
  std::vector<VolumePoint> points = std::move(volumes[id].contents.points);
  points.resize(std::min(points.size(), read->first_point));
  const std::vector<VolumePoint>& added = read->volume.contents.points;
  points.insert(points.end(), added.begin(), added.end());
  volumes[id] = std::move(read->volume);
  volumes[id].contents.points = std::move(points);
}

/// Times last: a scan whose time is missing is requested again.
void VolumeJournal::store(const VolumeMap& map) {
  const bool new_volumes = store_volumes(map);
  const bool new_times = store_times(map);
  const bool new_odom = store_odom(map);
  if (new_volumes || new_times || new_odom) journal_.sync();
}

bool VolumeJournal::store_volumes(const VolumeMap& map) {
  written_.resize(map.volumes().size());
  bool changed = false;
  for (std::size_t id = 0; id < written_.size(); ++id) {
    const PlacedVolume& placed = map.volumes()[id];
    Written& written = written_[id];
    const bool anchored = placed.anchor.has_value();
    if (placed.volume.scans() == written.scans && anchored == written.anchored) continue;
    const std::size_t released = placed.volume.released_points();
    const bool replaced = placed.replacements != written.replacements;
    VolumeRecord record{static_cast<int>(id), stored(placed), replaced ? 0 : written.points};
    std::vector<VolumePoint>& points = record.volume.contents.points;
    const std::size_t all_points = released + points.size();
    const std::size_t stored_points = record.first_point - released;
    points.erase(points.begin(), points.begin() + static_cast<std::ptrdiff_t>(stored_points));
    journal_.append(kScan, to_bytes(record));
    written = {placed.volume.scans(), all_points, anchored, placed.replacements};
    changed = true;
  }
  return changed;
}

bool VolumeJournal::store_times(const VolumeMap& map) {
  const bool changed = written_times_ < map.scan_utimes().size();
  for (; written_times_ < map.scan_utimes().size(); ++written_times_) {
    journal_.append(kTime, bytes_of(map.scan_utimes()[written_times_]));
  }
  return changed;
}

bool VolumeJournal::store_odom(const VolumeMap& map) {
  const auto& odom = map.newest_anchored_odom();
  if (!odom || odom == written_odom_) return false;
  journal_.append(kOdom, bytes_of(record_of(*odom)));
  written_odom_ = odom;
  return true;
}

}  // namespace adit

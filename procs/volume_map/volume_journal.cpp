// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "procs/volume_map/volume_journal.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <cstdint>
#include <optional>
#include <span>
#include <utility>

#include "procs/volume_map/volume_record.hpp"

namespace adit {
namespace {

constexpr std::string_view kScan = "VOLUME_SCAN";
constexpr std::string_view kTime = "VOLUME_SCAN_TIME";

using TimeBytes = std::array<std::uint8_t, sizeof(std::int64_t)>;

TimeBytes to_bytes(std::int64_t utime) { return std::bit_cast<TimeBytes>(utime); }

std::optional<std::int64_t> time_from(std::span<const std::uint8_t> bytes) {
  TimeBytes read{};
  if (bytes.size() != read.size()) return std::nullopt;
  std::ranges::copy(bytes, read.begin());
  return std::bit_cast<std::int64_t>(read);
}

}  // namespace

VolumeJournal::VolumeJournal(const std::filesystem::path& path)
    : journal_(path, [this](const JournalRecord& record) { read(record); }) {
  written_times_ = restored_.taken_utime.size();
  for (const StoredVolume& volume : restored_.volumes) {
    written_.push_back(
        {volume.contents.scans, volume.contents.points.size(), volume.tie.has_value(), 0});
  }
}

void VolumeJournal::read(const JournalRecord& record) {
  if (record.kind == kScan) read_volume(record);
  if (record.kind != kTime) return;
  if (const auto utime = time_from(record.bytes)) restored_.taken_utime.push_back(*utime);
}

/// The next sub-volume, or one that is there with more in it, or another in its place. One whose
/// first record is lost is made of the next one; of its points some are missing then.
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

/// The times last: a scan of which the end is missing is asked for again.
void VolumeJournal::keep(const VolumeMap& map) {
  const bool new_volumes = keep_volumes(map);
  const bool new_times = keep_times(map);
  if (new_volumes || new_times) journal_.sync();
}

bool VolumeJournal::keep_volumes(const VolumeMap& map) {
  written_.resize(map.volumes().size());
  bool news = false;
  for (std::size_t id = 0; id < written_.size(); ++id) {
    const PlacedVolume& placed = map.volumes()[id];
    Written& written = written_[id];
    const bool tied = placed.tie.has_value();
    if (placed.volume.scans() == written.scans && tied == written.tied) continue;
    const bool another = placed.renewals != written.renewals;
    const VolumeRecord record{static_cast<int>(id), stored(placed), another ? 0 : written.points};
    journal_.append(kScan, to_bytes(record));
    written = {placed.volume.scans(), placed.volume.points().size(), tied, placed.renewals};
    news = true;
  }
  return news;
}

bool VolumeJournal::keep_times(const VolumeMap& map) {
  const bool news = written_times_ < map.taken_utime().size();
  for (; written_times_ < map.taken_utime().size(); ++written_times_) {
    journal_.append(kTime, to_bytes(map.taken_utime()[written_times_]));
  }
  return news;
}

}  // namespace adit

// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "procs/volume_map/volume_journal.hpp"

#include <algorithm>
#include <utility>

#include "procs/volume_map/volume_record.hpp"

namespace adit {
namespace {

constexpr std::string_view kScan = "VOLUME_SCAN";

}  // namespace

VolumeJournal::VolumeJournal(const std::filesystem::path& path)
    : journal_(path, [this](const JournalRecord& record) { read(record); }) {
  for (const StoredVolume& volume : restored_) {
    written_.push_back(
        {volume.contents.scans, volume.contents.points.size(), volume.tie.has_value(), 0});
  }
}

/// The next sub-volume, or one that is there with more in it, or another in its place. One whose
/// first record is lost is made of the next one; of its points some are missing then.
void VolumeJournal::read(const JournalRecord& record) {
  if (record.kind != kScan) return;
  auto read = volume_record_from(record.bytes);
  if (!read) return;
  const auto id = static_cast<std::size_t>(read->id);
  if (id > restored_.size()) return;
  if (id == restored_.size()) {
    restored_.push_back(std::move(read->volume));
    return;
  }
  std::vector<VolumePoint> points = std::move(restored_[id].contents.points);
  points.resize(std::min(points.size(), read->first_point));
  const std::vector<VolumePoint>& added = read->volume.contents.points;
  points.insert(points.end(), added.begin(), added.end());
  restored_[id] = std::move(read->volume);
  restored_[id].contents.points = std::move(points);
}

void VolumeJournal::keep(const VolumeMap& map) {
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
  if (news) journal_.sync();
}

}  // namespace adit

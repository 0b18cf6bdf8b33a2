// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "procs/mapping/local_map_store.hpp"

#include <iterator>
#include <string>
#include <utility>

#include "common/files/raw_bytes.hpp"

namespace adit {
namespace {

void put_scan(const LocalScan& scan, RawWriter& bytes) {
  bytes.put_all(scan.channel);
  bytes.put(scan.scan.utime);
  bytes.put_all(scan.scan.ranges_m);
  bytes.put(scan.scan.angle_min_rad);
  bytes.put(scan.scan.angle_step_rad);
  bytes.put(scan.T_local_body);
  bytes.put(scan.z_m);
  bytes.put(scan.attitude.has_value());
  bytes.put(scan.attitude.value_or(Attitude{}));
  bytes.put_all(scan.unconfirmed_beams);
  bytes.put(scan.attitude_from_ground);
}

LocalScan take_scan(RawReader& reader) {
  LocalScan scan;
  scan.channel = reader.take_all<std::string>();
  scan.scan.utime = reader.take<std::int64_t>();
  scan.scan.ranges_m = reader.take_all<std::vector<float>>();
  scan.scan.angle_min_rad = reader.take<double>();
  scan.scan.angle_step_rad = reader.take<double>();
  scan.T_local_body = reader.take<Pose2>();
  scan.z_m = reader.take<double>();
  const bool has_attitude = reader.take<bool>();
  const auto attitude = reader.take<Attitude>();
  if (has_attitude) scan.attitude = attitude;
  scan.unconfirmed_beams = reader.take_all<std::vector<std::int32_t>>();
  scan.attitude_from_ground = reader.take<bool>();
  return scan;
}

}  // namespace

LocalMapStore::LocalMapStore(const std::filesystem::path& folder) {
  if (!folder.empty()) scans_.emplace(folder);
}

void LocalMapStore::push_back(LocalMap map) {
  if (!scans_) {
    maps_.push_back(std::move(map));
    return;
  }
  RawWriter bytes;
  bytes.put(map.scans.size());
  for (const LocalScan& scan : map.scans) put_scan(scan, bytes);
  offsets_.push_back(scans_->append(bytes.bytes()));
  if (!map.scans.empty()) {
    map.scans.erase(map.scans.begin(), std::prev(map.scans.end()));
    map.scans.shrink_to_fit();
    map.scans.front().scan.ranges_m = std::vector<float>();  // {} would keep their memory
    map.scans.front().unconfirmed_beams = std::vector<std::int32_t>();
  }
  maps_.push_back(std::move(map));
}

void LocalMapStore::pop_back() {
  maps_.pop_back();
  if (!scans_) return;
  scans_->truncate(offsets_.back());
  offsets_.pop_back();
}

LocalMap LocalMapStore::load(std::size_t i) const {
  LocalMap map = maps_[i];
  if (!scans_) return map;
  const std::uint64_t end = i + 1 < offsets_.size() ? offsets_[i + 1] : scans_->size();
  std::vector<std::uint8_t> bytes(static_cast<std::size_t>(end - offsets_[i]));
  scans_->read(offsets_[i], bytes);
  RawReader reader(bytes);
  map.scans.clear();
  for (auto left = reader.take<std::size_t>(); left > 0; --left) {
    map.scans.push_back(take_scan(reader));
  }
  return map;
}

std::vector<LocalMap> LocalMapStore::load_all() const {
  std::vector<LocalMap> maps;
  for (std::size_t i = 0; i < size(); ++i) maps.push_back(load(i));
  return maps;
}

}  // namespace adit

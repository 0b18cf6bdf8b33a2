// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "procs/mapping/map_journal.hpp"

#include <algorithm>
#include <iterator>
#include <optional>
#include <utility>

#include "common/messages/codec.hpp"
#include "common/messages/mapping/association.hpp"
#include "common/messages/mapping/local_map.hpp"

namespace adit {
namespace {

constexpr std::string_view kLocalMap = "LOCAL_MAP";
constexpr std::string_view kPart = "LOCAL_MAP_PART";
constexpr std::string_view kAssociation = "ASSOCIATION";

/// Assembles the stored map from records.
class Collector {
 public:
  explicit Collector(StoredMap& stored) : stored_(stored) {}

  void operator()(const JournalRecord& record) {
    if (record.kind == kLocalMap) add_fragment(record.bytes);
    if (record.kind == kPart) add_part(record.bytes);
    if (record.kind == kAssociation) add_association(record.bytes);
  }

 private:
  void add_fragment(std::span<const std::uint8_t> bytes) {
    const auto message = decode<local_map_t>(bytes);
    if (!message) return;
    const auto fragment = from_message(*message);
    if (!fragment) return;
    auto map = assembler_.add(*fragment);
    if (map && map->id == static_cast<int>(stored_.maps.size())) {
      stored_.maps.push_back(std::move(*map));
      stored_.unfinished.reset();
      parts_ = 0;
    }
  }

  /// A part after a lost one is discarded.
  void add_part(std::span<const std::uint8_t> bytes) {
    const auto message = decode<local_map_t>(bytes);
    if (!message) return;
    const auto decoded = from_message(*message);
    if (!decoded || decoded->part.id != static_cast<int>(stored_.maps.size())) return;
    LocalMapFragment read = *decoded;
    if (read.fragment == 0) {
      stored_.unfinished = std::move(read.part);
      parts_ = 1;
    } else if (stored_.unfinished && read.fragment == parts_ &&
               read.part.utime == stored_.unfinished->utime) {
      LocalMap& map = *stored_.unfinished;
      map.end_utime = read.part.end_utime;
      std::move(read.part.scans.begin(), read.part.scans.end(), std::back_inserter(map.scans));
      ++parts_;
    }
  }

  void add_association(std::span<const std::uint8_t> bytes) {
    const auto message = decode<association_t>(bytes);
    if (!message) return;
    const auto association = from_message(*message);
    if (!association) return;
    const int loop_closure = association->loop_closure.id;
    if (loop_closure > loop_closures_ ||
        association->loop_closure.newer_map >= static_cast<int>(stored_.maps.size())) {
      return;
    }
    loop_closures_ = std::max(loop_closures_, loop_closure + 1);
    stored_.associations.push_back(*association);
  }

  StoredMap& stored_;
  LocalMapReassembler assembler_;
  int loop_closures_ = 0;
  int parts_ = 0;  ///< of the unfinished local map
};

}  // namespace

MapJournal::MapJournal(const std::filesystem::path& path) : journal_(path, Collector(restored_)) {}

void MapJournal::append(const MapUpdate& update) {
  for (const LocalMapFragment& fragment : split(update.map)) {
    journal_.append(kLocalMap, encode(to_message(fragment)));
  }
  for (const Association& association : update.associations) {
    journal_.append(kAssociation, encode(to_message(association)));
  }
  journal_.sync();
}

void MapJournal::append_unfinished(const LocalMap& map) {
  if (map.id != parts_.id || map.utime != parts_.utime) parts_ = {map.id, map.utime, 0, 0};
  LocalMapFragment part{map, parts_.parts + 1, parts_.parts};
  auto& scans = part.part.scans;
  scans.erase(scans.begin(), scans.begin() + static_cast<std::ptrdiff_t>(parts_.scans));
  journal_.append(kPart, encode(to_message(part)));
  journal_.sync();
  parts_ = {map.id, map.utime, parts_.parts + 1, map.scans.size()};
}

StoredMap read_map_journal(const std::filesystem::path& path) {
  StoredMap stored;
  read_journal(path, Collector(stored));
  return stored;
}

}  // namespace adit

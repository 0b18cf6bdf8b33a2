// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "procs/mapping/map_journal.hpp"

#include <algorithm>
#include <iterator>
#include <optional>
#include <utility>

#include "common/messages/codec.hpp"
#include "common/messages/mapping/association.hpp"
#include "common/messages/mapping/cloud_match.hpp"
#include "common/messages/mapping/local_map.hpp"
#include "procs/mapping/map_gaps.hpp"

namespace adit {
namespace {

constexpr std::string_view kLocalMap = "LOCAL_MAP";
constexpr std::string_view kPart = "LOCAL_MAP_PART";
constexpr std::string_view kAssociation = "ASSOCIATION";
constexpr std::string_view kCloudMatch = "CLOUD_MATCH";
constexpr std::string_view kEndLost = "END_LOST";  // before this record; stays known after a repair

/// Assembles the stored map from records.
class Collector {
 public:
  explicit Collector(StoredMap& stored) : stored_(stored) {}

  void read(const JournalRecord& record) {
    if (record.kind == kLocalMap) add_fragment(record.bytes);
    if (record.kind == kPart) add_part(record.bytes);
    if (record.kind == kAssociation) add_association(record.bytes);
    if (record.kind == kCloudMatch) add_match(record.bytes);
    if (record.kind == kEndLost) stored_.losses.end = true;
  }

  /// To be called after the last record. Where nothing is left of a map, home is lost.
  void finish(const JournalHealth& health) {
    stored_.health = health;
    stored_.losses.end |= health.end_missing;
    if (health.has_loss() && stored_.maps.empty() && !stored_.unfinished) {
      append_empty(nullptr);
      stored_.losses.end = true;
    }
    if (!stored_.unfinished || stored_.losses.local_maps.empty()) return;
    if (stored_.losses.local_maps.back() == stored_.unfinished->id - 1)
      link_after_gap(*stored_.unfinished, stored_.maps.back());
  }

 private:
  void add_fragment(std::span<const std::uint8_t> bytes) {
    const auto message = decode<local_map_t>(bytes);
    if (!message) return;
    const auto fragment = from_message(*message);
    if (!fragment) return;
    auto map = assembler_.add(*fragment);
    if (!map || map->id < next_id()) return;
    fill_gap(map->id, &*map);
    std::erase(stored_.losses.shortened, map->id);  // the whole map is stored after its parts
    append(std::move(*map));
  }

  /// Each part has the place of its scans in odom, so that those after a lost one are used: where
  /// the robot was last must not be lost with it.
  void add_part(std::span<const std::uint8_t> bytes) {
    const auto message = decode<local_map_t>(bytes);
    if (!message) return;
    const auto decoded = from_message(*message);
    if (!decoded || decoded->part.id < next_id()) return;
    LocalMapFragment read = *decoded;
    fill_gap(read.part.id, &read.part);
    const bool continues =
        read.fragment > 0 && stored_.unfinished && read.part.utime == stored_.unfinished->utime;
    if (continues && read.fragment < parts_) return;
    const int expected = continues ? parts_ : 0;
    if (read.fragment > expected) add_shortened(read.part.id);
    parts_ = read.fragment + 1;
    if (!continues) {
      stored_.unfinished = std::move(read.part);
      return;
    }
    LocalMap& map = *stored_.unfinished;
    map.end_utime = read.part.end_utime;
    std::move(read.part.scans.begin(), read.part.scans.end(), std::back_inserter(map.scans));
  }

  void add_shortened(int id) {
    std::vector<int>& shortened = stored_.losses.shortened;
    if (std::ranges::find(shortened, id) == shortened.end()) shortened.push_back(id);
  }

  /// Without those after a lost one, whose numbers would not be theirs.
  void add_association(std::span<const std::uint8_t> bytes) {
    const auto message = decode<association_t>(bytes);
    if (!message) return;
    const auto association = from_message(*message);
    if (!association) return;
    const int loop_closure = association->loop_closure.id;
    if (loop_closure > loop_closures_ || association->loop_closure.newer_map >= next_id()) {
      ++stored_.losses.loop_closures;
      return;
    }
    loop_closures_ = std::max(loop_closures_, loop_closure + 1);
    stored_.associations.push_back(*association);
  }

  void add_match(std::span<const std::uint8_t> bytes) {
    const auto message = decode<cloud_match_t>(bytes);
    if (!message) return;
    const auto match = from_message(*message);
    if (match && match->newer.map < next_id()) stored_.cloud_matches.push_back(*match);
  }

  [[nodiscard]] int next_id() const { return static_cast<int>(stored_.maps.size()); }

  void append(LocalMap map) {
    const bool after_gap =
        !stored_.losses.local_maps.empty() && stored_.losses.local_maps.back() == map.id - 1;
    if (after_gap) link_after_gap(map, stored_.maps.back());
    stored_.maps.push_back(std::move(map));
    stored_.unfinished.reset();
    parts_ = 0;
  }

  /// The records of the local maps before `id` are lost. What is stored of the parts of the first
  /// one takes its place, an empty local map that of each other.
  void fill_gap(int id, const LocalMap* next) {
    if (next_id() < id && stored_.unfinished) {
      add_shortened(stored_.unfinished->id);
      append(std::move(*stored_.unfinished));
    }
    while (next_id() < id) append_empty(next);
  }

  void append_empty(const LocalMap* next) {
    const LocalMap* before = stored_.maps.empty() ? nullptr : &stored_.maps.back();
    LocalMap empty = empty_local_map(next_id(), before, next);
    stored_.losses.local_maps.push_back(empty.id);
    stored_.maps.push_back(std::move(empty));
  }

  StoredMap& stored_;
  LocalMapReassembler assembler_;
  int loop_closures_ = 0;
  int parts_ = 0;  ///< of the unfinished local map
};

Journal open(const std::filesystem::path& path, StoredMap& stored) {
  Collector collector(stored);
  Journal journal(path, [&](const JournalRecord& record) { collector.read(record); });
  collector.finish(journal.health());
  return journal;
}

}  // namespace

MapJournal::MapJournal(const std::filesystem::path& path) : journal_(open(path, restored_)) {
  report_ = map_journal_report(path, restored_);
  is_damaged_ = restored_.health.is_damaged() || restored_.losses.has_gap();
  if (!restored_.health.end_missing) return;
  journal_.append(kEndLost, {});
  journal_.sync();
}

void MapJournal::append(const MapUpdate& update) {
  for (const LocalMapFragment& fragment : split(update.map)) {
    journal_.append(kLocalMap, encode(to_message(fragment)));
  }
  for (const CloudMatch& match : update.cloud_matches) {
    journal_.append(kCloudMatch, encode(to_message(match)));
  }
  append(update.associations);
}

void MapJournal::append(const std::vector<Association>& associations) {
  for (const Association& association : associations) {
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
  Collector collector(stored);
  collector.finish(
      read_journal(path, [&](const JournalRecord& record) { collector.read(record); }));
  return stored;
}

std::string map_journal_report(const std::filesystem::path& path, const StoredMap& stored) {
  std::string report = journal_report(path, stored.health);
  const std::string losses = text_of(stored.losses);
  if (losses.empty()) return report;
  return (report.empty() ? path.filename().string() : report) + ": " + losses;
}

}  // namespace adit

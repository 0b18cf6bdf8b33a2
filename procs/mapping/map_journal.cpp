// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "procs/mapping/map_journal.hpp"

#include <algorithm>
#include <optional>

#include "common/messages/association.hpp"
#include "common/messages/codec.hpp"
#include "common/messages/local_map_pieces.hpp"

namespace adit {
namespace {

constexpr std::string_view kLocalMap = "LOCAL_MAP";
constexpr std::string_view kAssociation = "ASSOCIATION";

/// Puts records together.
class Collector {
 public:
  explicit Collector(StoredMap& stored) : stored_(stored) {}

  void operator()(const JournalRecord& record) {
    if (record.kind == kLocalMap) add_piece(record.bytes);
    if (record.kind == kAssociation) add_association(record.bytes);
  }

 private:
  void add_piece(std::span<const std::uint8_t> bytes) {
    const auto message = decode<local_map_t>(bytes);
    if (!message) return;
    const auto piece = from_message(*message);
    if (!piece) return;
    auto map = assembler_.add(*piece);
    if (map && map->id == static_cast<int>(stored_.maps.size())) {
      stored_.maps.push_back(std::move(*map));
    }
  }

  void add_association(std::span<const std::uint8_t> bytes) {
    const auto message = decode<association_t>(bytes);
    if (!message) return;
    const auto association = from_message(*message);
    if (!association) return;
    const int closure = association->closure.id;
    if (closure > closures_ ||
        association->closure.newer_map >= static_cast<int>(stored_.maps.size())) {
      return;
    }
    closures_ = std::max(closures_, closure + 1);
    stored_.associations.push_back(*association);
  }

  StoredMap& stored_;
  LocalMapAssembler assembler_;
  int closures_ = 0;
};

}  // namespace

MapJournal::MapJournal(const std::filesystem::path& path) : journal_(path, Collector(restored_)) {}

void MapJournal::append(const MapUpdate& update) {
  for (const LocalMapPiece& piece : divide(update.map)) {
    journal_.append(kLocalMap, encode(to_message(piece)));
  }
  for (const Association& association : update.associations) {
    journal_.append(kAssociation, encode(to_message(association)));
  }
  journal_.sync();
}

StoredMap read_map_journal(const std::filesystem::path& path) {
  StoredMap stored;
  read_journal(path, Collector(stored));
  return stored;
}

}  // namespace adit

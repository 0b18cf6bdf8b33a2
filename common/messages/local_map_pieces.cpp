// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "common/messages/local_map_pieces.hpp"

#include <algorithm>
#include <iterator>
#include <utility>

namespace adit {
namespace {

LocalMap head_of(const LocalMap& map) {
  LocalMap head;
  head.id = map.id;
  head.session = map.session;
  head.utime = map.utime;
  head.end_utime = map.end_utime;
  head.T_odom_local = map.T_odom_local;
  head.T_previous_local = map.T_previous_local;
  head.information = map.information;
  return head;
}

/// On the wire: the length of the channel and its NUL, time, pose, bearings, count, ranges.
std::size_t bytes_on_wire(const LocalScan& local) {
  constexpr std::size_t kFixed = 4 + 1 + 8 + 24 + 16 + 4;
  return kFixed + local.channel.size() + sizeof(float) * local.scan.ranges_m.size();
}

std::size_t bytes_in_memory(const std::vector<LocalScan>& scans) {
  std::size_t bytes = sizeof(LocalScan) * scans.size();
  for (const LocalScan& local : scans) {
    bytes += local.channel.size() + sizeof(float) * local.scan.ranges_m.size();
  }
  return bytes;
}

}  // namespace

std::vector<LocalMapPiece> divide(const LocalMap& map) {
  const LocalMapPiece empty{head_of(map), 1, 0};
  const auto bytes_of_head = static_cast<std::size_t>(to_message(empty).getEncodedSize());
  std::vector<LocalMapPiece> pieces = {empty};
  std::size_t bytes = bytes_of_head;
  for (const LocalScan& local : map.scans) {
    if (bytes + bytes_on_wire(local) > kPieceBytes && !pieces.back().part.scans.empty()) {
      pieces.push_back(empty);
      bytes = bytes_of_head;
    }
    pieces.back().part.scans.push_back(local);
    bytes += bytes_on_wire(local);
  }
  for (std::size_t i = 0; i < pieces.size(); ++i) {
    pieces[i].n_pieces = static_cast<int>(pieces.size());
    pieces[i].piece = static_cast<int>(i);
  }
  return pieces;
}

std::optional<LocalMap> LocalMapAssembler::add(const LocalMapPiece& piece) {
  ++pieces_seen_;
  Waiting* const waiting = place_for(piece);
  if (waiting == nullptr) return std::nullopt;
  if (!waiting->scans.add(piece.piece, piece.part.scans)) {
    ++counts_.duplicates;
    return std::nullopt;
  }
  const std::size_t bytes = bytes_in_memory(piece.part.scans);
  waiting->bytes += bytes;
  bytes_ += bytes;
  waiting->touched = pieces_seen_;
  if (waiting->scans.complete()) return take(piece.part.id);
  keep_within_limits();
  return std::nullopt;
}

/// Where the piece belongs; null where it belongs nowhere.
LocalMapAssembler::Waiting* LocalMapAssembler::place_for(const LocalMapPiece& piece) {
  LocalMap head = head_of(piece.part);
  const auto known = waiting_.find(head.id);
  if (known != waiting_.end()) {
    Waiting& waiting = known->second;
    if (head.end_utime < waiting.head.end_utime) {
      ++counts_.outdated;
      return nullptr;
    }
    if (head.end_utime == waiting.head.end_utime) {
      const bool same = head == waiting.head && waiting.scans.size() == std::size_t(piece.n_pieces);
      if (!same) ++counts_.contradictory;
      return same ? &waiting : nullptr;
    }
    ++counts_.superseded;
    erase(known);
  }
  const int id = head.id;
  Waiting fresh{std::move(head), PieceSet<std::vector<LocalScan>>(piece.n_pieces)};
  return &waiting_.emplace(id, std::move(fresh)).first->second;
}

LocalMap LocalMapAssembler::take(int id) {
  const auto waiting = waiting_.find(id);
  LocalMap map = waiting->second.head;
  for (const auto& scans : waiting->second.scans.pieces()) {
    map.scans.insert(map.scans.end(), scans->begin(), scans->end());
  }
  erase(waiting);
  ++counts_.joined;
  return map;
}

void LocalMapAssembler::keep_within_limits() {
  while (waiting_.size() > limits_.incomplete || bytes_ > limits_.bytes) {
    const auto oldest = std::min_element(
        waiting_.begin(), waiting_.end(),
        [](const auto& a, const auto& b) { return a.second.touched < b.second.touched; });
    if (oldest == waiting_.end()) return;
    ++counts_.given_up;
    erase(oldest);
  }
}

void LocalMapAssembler::erase(std::map<int, Waiting>::iterator waiting) {
  bytes_ -= waiting->second.bytes;
  waiting_.erase(waiting);
}

}  // namespace adit

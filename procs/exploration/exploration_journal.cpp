// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "procs/exploration/exploration_journal.hpp"

#include <algorithm>
#include <span>
#include <sstream>
#include <utility>

#include <fmt/format.h>

namespace adit {
namespace {

constexpr std::string_view kMap = "MAP";
constexpr std::string_view kFrontier = "FRONTIER";
constexpr std::string_view kBarriers = "BARRIERS";
constexpr std::string_view kState = "STATE";
constexpr std::string_view kGround = "GROUND";
constexpr int kFrontiersMax = 1'000'000;

std::span<const std::uint8_t> bytes_of(const std::string& text) {
  return {reinterpret_cast<const std::uint8_t*>(text.data()), text.size()};
}

std::string_view text_of(std::span<const std::uint8_t> bytes) {
  return {reinterpret_cast<const char*>(bytes.data()), bytes.size()};
}

/// The target and the request that it answers.
std::string target_text(const StoredExploration& stored) {
  const ExplorationMemory& memory = stored.exploration;
  const ExploreRequest request = stored.request.value_or(ExploreRequest{});
  return fmt::format("{} {} {} {:d} {:d} {} {} {:.17g} {:d} {:.17g}", static_cast<int>(memory.kind),
                     memory.target, memory.pursuit_local_map, memory.returning, memory.verify_walls,
                     request.utime, request.id, request.remaining_m, request.returning_home,
                     stored.distance_at_request_m);
}

std::string state_text(const StoredExploration& stored) {
  return fmt::format("{} {:.17g}\n", target_text(stored), stored.distance_travelled_m);
}

void read_state(std::string_view text, StoredExploration& stored) {
  std::istringstream in{std::string(text)};
  ExplorationMemory memory;
  ExploreRequest request;
  int kind = 0;
  double distance_at_request_m = 0.0;
  double distance_travelled_m = 0.0;
  in >> kind >> memory.target >> memory.pursuit_local_map >> memory.returning >>
      memory.verify_walls >> request.utime >> request.id >> request.remaining_m >>
      request.returning_home >> distance_at_request_m >> distance_travelled_m;
  memory.kind = ExplorationDecision::Kind(kind);
  if (!in || kind < 0 || memory.kind > ExplorationDecision::Kind::kDone) return;
  stored.exploration.kind = memory.kind;
  stored.exploration.target = memory.target;
  stored.exploration.pursuit_local_map = memory.pursuit_local_map;
  stored.exploration.returning = memory.returning;
  stored.exploration.verify_walls = memory.verify_walls;
  stored.request = request.id > 0 ? std::optional(request) : std::nullopt;
  stored.distance_at_request_m = distance_at_request_m;
  stored.distance_travelled_m = distance_travelled_m;
}

/// Stands in for a frontier whose record is lost, at a position where nothing is detected.
StoredFrontier lost_frontier(int id) {
  StoredFrontier lost;
  lost.frontier.id = id;
  lost.frontier.state = FrontierState::kExplored;
  lost.frontier.evidence = "its record is lost";
  lost.frontier.p_map = lost.track.p_local = {1e6, 1e6};
  return lost;
}

void put(StoredFrontier frontier, std::vector<StoredFrontier>& frontiers) {
  const auto id = static_cast<std::size_t>(frontier.frontier.id);
  while (frontiers.size() <= id)
    frontiers.push_back(lost_frontier(static_cast<int>(frontiers.size())));
  frontiers[id] = std::move(frontier);
}

/// Without its position in map, which follows from the graph and needs no record.
std::string without_map_position(StoredFrontier frontier) {
  frontier.frontier.p_map = frontier.frontier.direction_map = Eigen::Vector2d::Zero();
  return to_text(frontier);
}

}  // namespace

ExplorationJournal::ExplorationJournal(const std::filesystem::path& path)
    : journal_(path, [this](const JournalRecord& record) { read(record); }) {
  written_.map_utime = restored_.map_utime;
  for (const StoredFrontier& frontier : restored_.exploration.frontiers) {
    written_.frontiers.push_back(without_map_position(frontier));
  }
  written_.barriers = to_text(restored_.exploration.barriers);
  written_.target = target_text(restored_);
  written_.state = state_text(restored_);
}

void ExplorationJournal::read(const JournalRecord& record) {
  const std::string_view text = text_of(record.bytes);
  if (record.kind == kMap) {
    restored_ = {};
    std::istringstream(std::string(text)) >> restored_.map_utime;
  } else if (record.kind == kFrontier) {
    auto frontier = frontier_from_text(text);
    if (frontier && frontier->frontier.id < kFrontiersMax)
      put(std::move(*frontier), restored_.exploration.frontiers);
  } else if (record.kind == kBarriers) {
    if (auto barriers = barriers_from_text(text)) {
      restored_.exploration.barriers = std::move(*barriers);
    }
  } else if (record.kind == kGround) {
    if (auto ground = scanned_ground_from_text(text))
      restored_.grounds.push_back(std::move(*ground));
  } else if (record.kind == kState) {
    read_state(text, restored_);
  }
}

void ExplorationJournal::store(const StoredExploration& stored) {
  bool important = stored.map_utime != written_.map_utime;
  if (important) begin_map(stored.map_utime);
  const auto& frontiers = stored.exploration.frontiers;
  written_.frontiers.resize(std::max(frontiers.size(), written_.frontiers.size()));
  for (std::size_t i = 0; i < frontiers.size(); ++i) {
    const std::string text = without_map_position(frontiers[i]);
    if (text == written_.frontiers[i]) continue;
    journal_.append(kFrontier, bytes_of(to_text(frontiers[i])));
    written_.frontiers[i] = text;
    important = true;
  }
  important |= append(kBarriers, to_text(stored.exploration.barriers), written_.barriers);
  append(kState, state_text(stored), written_.state);
  const std::string target = target_text(stored);
  important |= target != written_.target;
  written_.target = target;
  if (important) journal_.sync();
}

void ExplorationJournal::append(std::int64_t map_utime, const ScannedGround& ground) {
  if (map_utime != written_.map_utime) begin_map(map_utime);
  journal_.append(kGround, bytes_of(to_text(ground)));
}

void ExplorationJournal::begin_map(std::int64_t map_utime) {
  journal_.append(kMap, bytes_of(std::to_string(map_utime)));
  written_ = {};
  written_.map_utime = map_utime;
}

bool ExplorationJournal::append(std::string_view kind, const std::string& text,
                                std::string& written) {
  if (text == written) return false;
  journal_.append(kind, bytes_of(text));
  written = text;
  return true;
}

}  // namespace adit

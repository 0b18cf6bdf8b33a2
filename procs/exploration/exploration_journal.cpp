// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "procs/exploration/exploration_journal.hpp"

#include <algorithm>
#include <iomanip>
#include <limits>
#include <span>
#include <sstream>
#include <utility>

namespace adit {
namespace {

constexpr std::string_view kMap = "MAP";
constexpr std::string_view kStub = "STUB";
constexpr std::string_view kBarriers = "BARRIERS";
constexpr std::string_view kState = "STATE";
constexpr int kStubsMax = 1'000'000;

std::span<const std::uint8_t> bytes_of(const std::string& text) {
  return {reinterpret_cast<const std::uint8_t*>(text.data()), text.size()};
}

std::string_view text_of(std::span<const std::uint8_t> bytes) {
  return {reinterpret_cast<const char*>(bytes.data()), bytes.size()};
}

/// Where the robot was going to, and who asked.
std::string target_text(const KeptExploration& kept) {
  const ExplorationMemory& memory = kept.exploration;
  const ExploreRequest request = kept.request.value_or(ExploreRequest{});
  std::ostringstream out;
  out << std::setprecision(std::numeric_limits<double>::max_digits10);
  out << static_cast<int>(memory.kind) << ' ' << memory.target << ' ' << memory.newest_seen << ' '
      << memory.returning << ' ' << request.utime << ' ' << request.id << ' ' << request.remaining_m
      << ' ' << request.homeward << ' ' << kept.requested_m;
  return out.str();
}

std::string state_text(const KeptExploration& kept) {
  std::ostringstream out;
  out << std::setprecision(std::numeric_limits<double>::max_digits10);
  out << target_text(kept) << ' ' << kept.travelled_m << '\n';
  return out.str();
}

void read_state(std::string_view text, KeptExploration& kept) {
  std::istringstream in{std::string(text)};
  ExplorationMemory memory;
  ExploreRequest request;
  int kind = 0;
  double requested_m = 0.0;
  double travelled_m = 0.0;
  in >> kind >> memory.target >> memory.newest_seen >> memory.returning >> request.utime >>
      request.id >> request.remaining_m >> request.homeward >> requested_m >> travelled_m;
  memory.kind = ExplorationDecision::Kind(kind);
  if (!in || kind < 0 || memory.kind > ExplorationDecision::Kind::kDone) return;
  kept.exploration.kind = memory.kind;
  kept.exploration.target = memory.target;
  kept.exploration.newest_seen = memory.newest_seen;
  kept.exploration.returning = memory.returning;
  kept.request = request.id > 0 ? std::optional(request) : std::nullopt;
  kept.requested_m = requested_m;
  kept.travelled_m = travelled_m;
}

/// One that was lost. It lies where nothing is found.
RememberedStub lost_stub(int id) {
  RememberedStub lost;
  lost.stub.id = id;
  lost.stub.state = StubState::kExplored;
  lost.stub.evidence = "what was known of it is lost";
  lost.stub.p_map = lost.hold.p_local = {1e6, 1e6};
  return lost;
}

void put(RememberedStub stub, std::vector<RememberedStub>& stubs) {
  const auto id = static_cast<std::size_t>(stub.stub.id);
  while (stubs.size() <= id) stubs.push_back(lost_stub(static_cast<int>(stubs.size())));
  stubs[id] = std::move(stub);
}

/// Without where the graph has it at present, which needs no record.
std::string without_place(RememberedStub stub) {
  stub.stub.p_map = stub.stub.direction_map = Eigen::Vector2d::Zero();
  return to_text(stub);
}

}  // namespace

ExplorationJournal::ExplorationJournal(const std::filesystem::path& path)
    : journal_(path, [this](const JournalRecord& record) { read(record); }) {
  written_.map_utime = restored_.map_utime;
  for (const RememberedStub& stub : restored_.exploration.stubs) {
    written_.stubs.push_back(without_place(stub));
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
  } else if (record.kind == kStub) {
    auto stub = stub_from_text(text);
    if (stub && stub->stub.id < kStubsMax) put(std::move(*stub), restored_.exploration.stubs);
  } else if (record.kind == kBarriers) {
    if (auto barriers = barriers_from_text(text)) {
      restored_.exploration.barriers = std::move(*barriers);
    }
  } else if (record.kind == kState) {
    read_state(text, restored_);
  }
}

void ExplorationJournal::keep(const KeptExploration& kept) {
  bool important = kept.map_utime != written_.map_utime;
  if (important) begin_map(kept.map_utime);
  const auto& stubs = kept.exploration.stubs;
  written_.stubs.resize(std::max(stubs.size(), written_.stubs.size()));
  for (std::size_t i = 0; i < stubs.size(); ++i) {
    const std::string text = without_place(stubs[i]);
    if (text == written_.stubs[i]) continue;
    journal_.append(kStub, bytes_of(to_text(stubs[i])));
    written_.stubs[i] = text;
    important = true;
  }
  important |= append(kBarriers, to_text(kept.exploration.barriers), written_.barriers);
  append(kState, state_text(kept), written_.state);
  const std::string target = target_text(kept);
  important |= target != written_.target;
  written_.target = target;
  if (important) journal_.sync();
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

// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "procs/exploration/exploration_memory.hpp"

#include <sstream>
#include <utility>

#include <fmt/format.h>

namespace adit {
namespace {

/// With 17 digits, which restore a double exactly.
std::string text_of(const Eigen::Vector2d& v) {
  return fmt::format("{:.17g} {:.17g}", v.x(), v.y());
}

void get(std::istream& in, Eigen::Vector2d& v) { in >> v.x() >> v.y(); }

/// The rest of a line, without its leading space.
void get_sentence(std::istream& in, std::string& sentence) {
  in.get();
  std::getline(in, sentence);
}

/// Replaces line breaks by spaces.
std::string one_line(std::string sentence) {
  for (char& c : sentence) {
    if (c == '\n') c = ' ';
  }
  return sentence;
}

}  // namespace

std::string to_text(const StoredFrontier& frontier) {
  const auto& [s, track] = frontier;
  return fmt::format("{} {} {:.17g} {} {} {} {} {:d} {} {:.17g} {} {} {:d} {} {} {} {} {}\n", s.id,
                     s.local_map, s.width_m, static_cast<int>(s.state), s.utime,
                     text_of(track.p_local), text_of(track.direction_local), track.final,
                     track.stalls, track.path_length_min_m, text_of(track.p_map_at_min),
                     track.closings, track.retried, track.rejections, text_of(track.p_map_rejected),
                     text_of(s.p_map), text_of(s.direction_map), one_line(s.evidence));
}

std::optional<StoredFrontier> frontier_from_text(std::string_view text) {
  std::istringstream in{std::string(text)};
  StoredFrontier frontier;
  auto& [s, track] = frontier;
  int state = 0;
  in >> s.id >> s.local_map >> s.width_m >> state >> s.utime;
  get(in, track.p_local);
  get(in, track.direction_local);
  in >> track.final >> track.stalls >> track.path_length_min_m;
  get(in, track.p_map_at_min);
  in >> track.closings >> track.retried >> track.rejections;
  get(in, track.p_map_rejected);
  get(in, s.p_map);
  get(in, s.direction_map);
  get_sentence(in, s.evidence);
  s.state = FrontierState(state);
  const bool is_state = s.state >= FrontierState::kOpen && s.state <= FrontierState::kUnconfirmed;
  if (!in || s.id < 0 || s.local_map < 0 || !is_state) return std::nullopt;
  return frontier;
}

std::string to_text(const std::vector<Barrier>& barriers) {
  std::string text;
  for (const Barrier& barrier : barriers) {
    text += fmt::format("{} {} {} {} {} {}\n", static_cast<int>(barrier.kind), barrier.frontier,
                        barrier.local_map, text_of(barrier.p_local),
                        text_of(barrier.direction_local), one_line(barrier.evidence));
  }
  return text;
}

std::optional<std::vector<Barrier>> barriers_from_text(std::string_view text) {
  std::istringstream in{std::string(text)};
  std::vector<Barrier> barriers;
  int kind = 0;
  while (in >> kind) {
    Barrier barrier;
    in >> barrier.frontier >> barrier.local_map;
    get(in, barrier.p_local);
    get(in, barrier.direction_local);
    get_sentence(in, barrier.evidence);
    if (!in || kind < 0 || kind > static_cast<int>(Barrier::Kind::kUnconfirmed))
      return std::nullopt;
    barrier.kind = Barrier::Kind(kind);
    barriers.push_back(std::move(barrier));
  }
  if (!in.eof()) return std::nullopt;
  return barriers;
}

}  // namespace adit

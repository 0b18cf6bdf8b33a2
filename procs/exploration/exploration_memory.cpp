// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "procs/exploration/exploration_memory.hpp"

#include <iomanip>
#include <limits>
#include <sstream>
#include <utility>

namespace adit {
namespace {

std::ostringstream writer() {
  std::ostringstream out;
  out << std::setprecision(std::numeric_limits<double>::max_digits10);
  return out;
}

void put(std::ostream& out, const Eigen::Vector2d& v) { out << v.x() << ' ' << v.y() << ' '; }

void get(std::istream& in, Eigen::Vector2d& v) { in >> v.x() >> v.y(); }

/// The rest of a line, without the space that it begins with.
void get_sentence(std::istream& in, std::string& sentence) {
  in.get();
  std::getline(in, sentence);
}

/// A sentence is one line.
std::string one_line(std::string sentence) {
  for (char& c : sentence) {
    if (c == '\n') c = ' ';
  }
  return sentence;
}

}  // namespace

std::string to_text(const StoredFrontier& frontier) {
  const auto& [s, track] = frontier;
  std::ostringstream out = writer();
  out << s.id << ' ' << s.local_map << ' ' << s.width_m << ' ' << static_cast<int>(s.state) << ' '
      << s.utime << ' ';
  put(out, track.p_local);
  put(out, track.direction_local);
  out << track.final << ' ' << track.stalls << ' ' << track.path_length_min_m << ' ';
  put(out, track.p_map_at_min);
  out << track.closings << ' ' << track.retried << ' ';
  put(out, s.p_map);
  put(out, s.direction_map);
  out << one_line(s.evidence) << '\n';
  return out.str();
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
  in >> track.closings >> track.retried;
  get(in, s.p_map);
  get(in, s.direction_map);
  get_sentence(in, s.evidence);
  s.state = FrontierState(state);
  const bool known = s.state >= FrontierState::kOpen && s.state <= FrontierState::kUnconfirmed;
  if (!in || s.id < 0 || s.local_map < 0 || !known) return std::nullopt;
  return frontier;
}

std::string to_text(const std::vector<Barrier>& barriers) {
  std::ostringstream out = writer();
  for (const Barrier& barrier : barriers) {
    out << static_cast<int>(barrier.kind) << ' ' << barrier.frontier << ' ' << barrier.local_map
        << ' ';
    put(out, barrier.p_local);
    put(out, barrier.direction_local);
    out << one_line(barrier.evidence) << '\n';
  }
  return out.str();
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

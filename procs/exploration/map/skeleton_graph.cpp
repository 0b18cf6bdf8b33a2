// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "procs/exploration/map/skeleton_graph.hpp"

#include <algorithm>
#include <array>
#include <limits>
#include <optional>
#include <utility>
#include <vector>

namespace adit {
namespace {

/// Bit mask of the neighbours that are set, counter-clockwise from +x.
unsigned neighbours(const Grid2<std::uint8_t>& mask, std::size_t at,
                    const std::array<std::ptrdiff_t, 8>& around) {
  unsigned bits = 0;
  for (unsigned i = 0; i < 8; ++i) {
    bits |= static_cast<unsigned>(mask[at + static_cast<std::size_t>(around[i])]) << i;
  }
  return bits;
}

/// Deletion conditions of Guo and Hall (1989, algorithm A1): crossing number, 2 or 3 neighbour
/// pairs, and the directional condition of the subiteration. The second subiteration is the first
/// one rotated by half a turn.
bool is_removable(unsigned bits, bool second_subiteration) {
  const auto p = [&](unsigned i) {
    return (bits >> ((i + (second_subiteration ? 4U : 0U)) % 8U) & 1U) != 0;
  };
  int crossings = 0;
  int pairs_1 = 0;
  int pairs_2 = 0;
  for (unsigned i = 0; i < 8; i += 2) {
    crossings += static_cast<int>(!p(i) && (p(i + 1) || p(i + 2)));
    pairs_1 += static_cast<int>(p(i + 7) || p(i));
    pairs_2 += static_cast<int>(p(i) || p(i + 1));
  }
  const int pairs = std::min(pairs_1, pairs_2);
  if (crossings != 1 || pairs < 2 || pairs > 3) return false;
  return !((p(4) || p(5) || !p(7)) && p(6));
}

using Table = std::array<std::array<bool, 256>, 2>;

Table make_table() {
  Table table{};
  for (unsigned bits = 0; bits < 256; ++bits) {
    table[0][bits] = is_removable(bits, false);
    table[1][bits] = is_removable(bits, true);
  }
  return table;
}

}  // namespace

Grid2<std::uint8_t> skeleton(const DrivableSpace& space) {
  static const Table kTable = make_table();
  Grid2<std::uint8_t> mask(space.known.box());
  const auto around = mask.around();
  for (std::size_t i = 0; i < mask.size(); ++i) {
    mask[i] = static_cast<std::uint8_t>(space.access[i] == Access::kReachable &&
                                        !space.shared.is_repeated(i));
  }
  std::vector<std::size_t> rim;
  for (std::size_t i = 0; i < mask.size(); ++i) {
    if (mask[i] != 0 && neighbours(mask, i, around) != 255U) rim.push_back(i);
  }
  std::vector<std::size_t> removed;
  Grid2<std::uint32_t> queued(space.known.box());
  for (std::uint32_t round = 1; !rim.empty(); ++round) {
    std::vector<std::size_t> next;
    const auto queue = [&](std::size_t cell) {
      if (mask[cell] == 0 || queued[cell] == round) return;
      queued[cell] = round;
      next.push_back(cell);
    };
    for (const auto& is_removable_now : kTable) {
      removed.clear();
      for (const std::size_t cell : rim) {
        if (mask[cell] != 0 && is_removable_now[neighbours(mask, cell, around)])
          removed.push_back(cell);
      }
      for (const std::size_t cell : removed) mask[cell] = 0;
      for (const std::size_t cell : removed) {
        for (const std::ptrdiff_t step : around) queue(cell + static_cast<std::size_t>(step));
      }
    }
    rim = std::move(next);
  }
  return mask;
}

namespace {

constexpr int kPath = -1;                    // value of a cell that is not part of a node
constexpr std::size_t kPointEveryCells = 5;  // every so many cells of a line one becomes a point

/// Distance to a line segment, or to its start if both ends coincide.
double distance_to_line(const Eigen::Vector2d& p, const Eigen::Vector2d& from,
                        const Eigen::Vector2d& to) {
  const Eigen::Vector2d along = to - from;
  const double square = along.squaredNorm();
  const double share = square > 0.0 ? std::clamp((p - from).dot(along) / square, 0.0, 1.0) : 0.0;
  return (p - from - share * along).norm();
}

/// Traces the cells of a skeleton from node to node.
class Tracer {
 public:
  Tracer(const DrivableSpace& space, const Grid2<std::uint8_t>& skeleton)
      : space_(space),
        skeleton_(skeleton),
        around_(skeleton.around()),
        node_(skeleton.box(), kPath),
        traced_(skeleton.box()) {}

  LineGraph run() {
    for (std::size_t i = 0; i < skeleton_.size(); ++i) {
      if (skeleton_[i] != 0 && node_[i] == kPath && degree(i) != 2) add_node(i);
    }
    for (std::size_t i = 0; i < skeleton_.size(); ++i) {
      if (skeleton_[i] != 0 && node_[i] != kPath) trace_from(i);
    }
    for (std::size_t i = 0; i < skeleton_.size(); ++i) {
      if (skeleton_[i] == 0 || node_[i] != kPath || traced_[i] != 0) continue;
      add_node(i);  // a loop without junctions
      trace_from(i);
    }
    return std::move(graph_);
  }

 private:
  [[nodiscard]] std::size_t neighbour(std::size_t cell, std::size_t i) const {
    return cell + static_cast<std::size_t>(around_[i]);
  }

  [[nodiscard]] int degree(std::size_t cell) const {
    int degree = 0;
    for (std::size_t i = 0; i < 8; ++i) degree += skeleton_[neighbour(cell, i)];
    return degree;
  }

  /// Adjacent junction cells become one node.
  void add_node(std::size_t first) {
    const int node = static_cast<int>(graph_.nodes.size());
    std::vector<std::size_t> cells{first};
    node_[first] = node;
    for (std::size_t k = 0; k < cells.size() && degree(first) > 2; ++k) {
      for (std::size_t i = 0; i < 8; ++i) {
        const std::size_t next = neighbour(cells[k], i);
        if (skeleton_[next] == 0 || node_[next] != kPath || degree(next) <= 2) continue;
        node_[next] = node;
        cells.push_back(next);
      }
    }
    LineNode added;
    for (const std::size_t cell : cells) {
      added.p_map += space_.middle(cell) / static_cast<double>(cells.size());
      added.clearance_m = std::max(added.clearance_m, double{space_.clearance_m[cell]});
    }
    graph_.nodes.push_back(added);
  }

  void trace_from(std::size_t cell) {
    for (std::size_t i = 0; i < 8; ++i) {
      const std::size_t next = neighbour(cell, i);
      if (skeleton_[next] == 0) continue;
      if (node_[next] == kPath && traced_[next] == 0) trace(cell, next);
      if (node_[next] > node_[cell]) add_line(cell, next, {});
    }
  }

  void trace(std::size_t from, std::size_t first) {
    std::vector<std::size_t> cells{first};
    traced_[first] = 1;
    std::size_t last = from;
    while (true) {
      const auto next = next_along(cells.back(), last);
      if (!next) return;
      if (node_[*next] != kPath) return add_line(from, *next, cells);
      last = cells.back();
      cells.push_back(*next);
      traced_[*next] = 1;
    }
  }

  /// The other neighbour of a cell of degree two; empty at the end of a traced line.
  [[nodiscard]] std::optional<std::size_t> next_along(std::size_t cell, std::size_t last) const {
    for (std::size_t i = 0; i < 8; ++i) {
      const std::size_t next = neighbour(cell, i);
      if (skeleton_[next] == 0 || next == last) continue;
      if (node_[next] != kPath || traced_[next] == 0) return next;
    }
    return std::nullopt;
  }

  void add_line(std::size_t from, std::size_t to, const std::vector<std::size_t>& cells) {
    Line line;
    line.from = node_[from];
    line.to = node_[to];
    line.clearance_m = std::min(space_.clearance_m[from], space_.clearance_m[to]);
    line.points.push_back(graph_.nodes[static_cast<std::size_t>(line.from)].p_map);
    for (std::size_t k = 0; k < cells.size(); ++k) {
      line.clearance_m = std::min(line.clearance_m, double{space_.clearance_m[cells[k]]});
      if (k % kPointEveryCells == kPointEveryCells - 1 && k + kPointEveryCells / 2 < cells.size()) {
        line.points.push_back(space_.middle(cells[k]));
      }
    }
    line.points.push_back(graph_.nodes[static_cast<std::size_t>(line.to)].p_map);
    graph_.lines.push_back(std::move(line));
  }

  const DrivableSpace& space_;
  const Grid2<std::uint8_t>& skeleton_;
  std::array<std::ptrdiff_t, 8> around_;
  Grid2<int> node_;
  Grid2<std::uint8_t> traced_;
  LineGraph graph_;
};

}  // namespace

LineGraph line_graph(const DrivableSpace& space, const Grid2<std::uint8_t>& skeleton) {
  return Tracer(space, skeleton).run();
}

std::vector<Eigen::Vector2d> simplified(const std::vector<Eigen::Vector2d>& points,
                                        double tolerance_m) {
  std::vector<bool> retained(points.size());
  if (!points.empty()) retained.front() = retained.back() = true;
  std::vector<std::pair<std::size_t, std::size_t>> spans;
  if (points.size() > 2) spans.emplace_back(0, points.size() - 1);
  while (!spans.empty()) {
    const auto [from, to] = spans.back();
    spans.pop_back();
    double farthest = tolerance_m;
    std::size_t split = from;
    for (std::size_t i = from + 1; i < to; ++i) {
      const double off = distance_to_line(points[i], points[from], points[to]);
      if (off <= farthest) continue;
      farthest = off;
      split = i;
    }
    if (split == from) continue;
    retained[split] = true;
    spans.emplace_back(from, split);
    spans.emplace_back(split, to);
  }
  std::vector<Eigen::Vector2d> result;
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (retained[i]) result.push_back(points[i]);
  }
  return result;
}

double length_of(const std::vector<Eigen::Vector2d>& points) {
  double length = 0.0;
  for (std::size_t i = 1; i < points.size(); ++i) length += (points[i] - points[i - 1]).norm();
  return length;
}

}  // namespace adit

// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "sim/world/short_walls.hpp"

#include <cstddef>
#include <numeric>

namespace adit {
namespace {

using Indices = std::vector<std::uint32_t>;

/// Points into which others go, as indices of the points before.
class Joiner {
 public:
  Joiner(PlanMesh& mesh, double shortest_m)
      : mesh_(mesh), shortest_m_(shortest_m), goes_into_(mesh.points.size()) {
    std::iota(goes_into_.begin(), goes_into_.end(), 0U);
  }

  void run() {
    std::vector<bool> done(mesh_.points.size(), false);
    for (std::uint32_t start = 0; start < done.size(); ++start) {
      if (!mesh_.is_on_wall(start) || done[start]) continue;
      const std::size_t count = mark_wall(start, done);
      join_along(end_of_long_step(start, count), count);
    }
    leave_out_joined();
  }

 private:
  /// Counts its points.
  std::size_t mark_wall(std::uint32_t start, std::vector<bool>& done) const {
    std::size_t count = 0;
    for (std::uint32_t i = start; !done[i]; i = mesh_.next_on_wall[i]) {
      done[i] = true;
      ++count;
    }
    return count;
  }

  /// Where to begin, so that the way around ends with a step that stays.
  [[nodiscard]] std::uint32_t end_of_long_step(std::uint32_t start, std::size_t count) const {
    std::uint32_t i = start;
    for (std::size_t k = 0; k < count && is_short(i); ++k) i = mesh_.next_on_wall[i];
    return mesh_.next_on_wall[i];
  }

  /// Whether the next point of the wall is too near.
  [[nodiscard]] bool is_short(std::uint32_t i) const {
    return (mesh_.points[mesh_.next_on_wall[i]] - mesh_.points[i]).norm() < shortest_m_;
  }

  void join_along(std::uint32_t start, std::size_t count) {
    std::uint32_t i = start;
    do {
      const std::uint32_t j = mesh_.next_on_wall[i];
      if (j == start || count <= 3 || !is_short(i)) {
        i = j;
        continue;
      }
      mesh_.points[i] = (mesh_.points[i] + mesh_.points[j]) / 2.0;
      mesh_.next_on_wall[i] = mesh_.next_on_wall[j];
      goes_into_[j] = i;
      --count;
    } while (i != start);
  }

  void leave_out_joined() {
    Indices index(mesh_.points.size());
    PlanMesh kept;
    for (std::uint32_t i = 0; i < index.size(); ++i) {
      index[i] = static_cast<std::uint32_t>(kept.points.size());
      if (goes_into_[i] != i) continue;
      kept.points.push_back(mesh_.points[i]);
      kept.next_on_wall.push_back(mesh_.next_on_wall[i]);
    }
    const auto renamed = [&](std::uint32_t i) { return index[goes_into_[i]]; };
    for (std::uint32_t& next : kept.next_on_wall) {
      if (next != PlanMesh::kNone) next = renamed(next);
    }
    for (const auto& [a, b, c] : mesh_.triangles) {
      const std::array<std::uint32_t, 3> triangle{renamed(a), renamed(b), renamed(c)};
      const bool flat =
          triangle[0] == triangle[1] || triangle[1] == triangle[2] || triangle[2] == triangle[0];
      if (!flat) kept.triangles.push_back(triangle);
    }
    mesh_ = std::move(kept);
  }

  PlanMesh& mesh_;
  double shortest_m_;
  Indices goes_into_;  ///< for each point itself, or the one before it on its wall
};

}  // namespace

void join_short_walls(PlanMesh& mesh, double shortest_m) { Joiner(mesh, shortest_m).run(); }

}  // namespace adit

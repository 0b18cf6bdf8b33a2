// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <vector>

#include <Eigen/Core>

namespace adit {

/// A place on the traversed path where a local map begins.
struct PatrolPlace {
  int local_map = 0;
  Eigen::Vector2d p_map{0.0, 0.0};
};

/// Selects the next place in an explored mine, to detect changes: the one visited longest ago.
/// Places on the path there are visited too, so that all are visited in turn. Nothing is stored
/// over a restart: places not visited since then come first, in the order in which they were
/// mapped.
class Patrol {
 public:
  static constexpr double kPassedM = 3.0;  ///< radius around a place; lasers see farther

  /// Marks all places near the body as visited.
  void pass(const std::vector<PatrolPlace>& places, const Eigen::Vector2d& p_map_body,
            std::int64_t utime);
  /// Marks a place as visited because no path leads there.
  void mark_unreachable(int local_map, std::int64_t utime) { passed_[local_map] = utime; }

  /// The place visited longest ago, of equals the one mapped first; empty if there are none. Stays
  /// the same until that place is passed.
  [[nodiscard]] std::optional<PatrolPlace> next(const std::vector<PatrolPlace>& places) const;

 private:
  [[nodiscard]] std::int64_t passed(int local_map) const;

  std::map<int, std::int64_t> passed_;  ///< by local map; absent if never
};

}  // namespace adit

// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <vector>

#include <Eigen/Core>

namespace adit {

/// A place on the way of the body, where a local map began.
struct PatrolPlace {
  int local_map = 0;
  Eigen::Vector2d p_map{0.0, 0.0};
};

/// Where to go in a mine of which nothing is left to be explored, to see whether all is as it was:
/// to the place where the body has not been for the longest time. Who goes there passes others on
/// the way, so that all are seen again and again. Nothing of it is kept over a restart: a place
/// that was not passed since then comes before all others, in the order in which they were mapped.
class Patrol {
 public:
  static constexpr double kPassedM = 3.0;  ///< from a place; a laser sees farther

  /// The body is here: it has been at all places this near.
  void pass(const std::vector<PatrolPlace>& places, const Eigen::Vector2d& p_map_body,
            std::int64_t utime);
  /// That one counts as passed, though it was not: no path led there.
  void mark_unreachable(int local_map, std::int64_t utime) { passed_[local_map] = utime; }

  /// Of these the one where the body was longest ago, of equals the one that was mapped first;
  /// nothing where there are none. It stays the same until that place is passed.
  [[nodiscard]] std::optional<PatrolPlace> next(const std::vector<PatrolPlace>& places) const;

 private:
  [[nodiscard]] std::int64_t passed(int local_map) const;

  std::map<int, std::int64_t> passed_;  ///< by local map; those that are not here: never
};

}  // namespace adit

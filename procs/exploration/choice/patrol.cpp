// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "procs/exploration/choice/patrol.hpp"

#include <algorithm>

namespace adit {

void Patrol::pass(const std::vector<PatrolPlace>& places, const Eigen::Vector2d& p_map_body,
                  std::int64_t utime) {
  for (const PatrolPlace& place : places) {
    if ((place.p_map - p_map_body).norm() <= kPassedM) passed_[place.local_map] = utime;
  }
}

std::int64_t Patrol::passed(int local_map) const {
  const auto found = passed_.find(local_map);
  return found == passed_.end() ? 0 : found->second;
}

std::optional<PatrolPlace> Patrol::next(const std::vector<PatrolPlace>& places) const {
  const auto oldest = std::min_element(
      places.begin(), places.end(), [this](const PatrolPlace& a, const PatrolPlace& b) {
        const auto passed_a = passed(a.local_map);
        const auto passed_b = passed(b.local_map);
        return passed_a != passed_b ? passed_a < passed_b : a.local_map < b.local_map;
      });
  return oldest == places.end() ? std::nullopt : std::optional(*oldest);
}

}  // namespace adit

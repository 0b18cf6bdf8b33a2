// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "procs/exploration/simple_rules.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <stdexcept>

namespace adit {
namespace {

constexpr double kNearM = 15.0;

int nearest(const std::vector<StubOffer>& offers) {
  return std::min_element(offers.begin(), offers.end(),
                          [](const StubOffer& a, const StubOffer& b) { return a.way_m < b.way_m; })
      ->stub;
}

/// Bearings count from behind by the right to the left.
int rightmost(const std::vector<StubOffer>& offers, const std::vector<Stub>& stubs,
              const Pose2& T_map_body) {
  int best = nearest(offers);
  double least = std::numeric_limits<double>::infinity();
  for (const StubOffer& offer : offers) {
    if (offer.way_m > kNearM) continue;
    const Eigen::Vector2d p_body =
        T_map_body.inverse() * stubs[static_cast<std::size_t>(offer.stub)].p_map;
    const double bearing = std::atan2(p_body.y(), p_body.x());
    if (bearing >= least) continue;
    least = bearing;
    best = offer.stub;
  }
  return best;
}

/// Without a state of its own, so that it goes on after a restart as it would have.
int any(const std::vector<StubOffer>& offers) {
  std::uint64_t state = 42;
  for (const StubOffer& offer : offers) {
    state = (state + static_cast<std::uint64_t>(offer.stub)) * 6364136223846793005ULL +
            1442695040888963407ULL;  // D. Knuth's MMIX
  }
  return offers[(state >> 33U) % offers.size()].stub;
}

}  // namespace

std::optional<int> choose_by(const std::string& rule, const std::vector<StubOffer>& offers,
                             const std::vector<Stub>& stubs, const Pose2& T_map_body, int target) {
  if (offers.empty()) return std::nullopt;
  if (rule == "nearest") return nearest(offers);
  const bool is_offered = std::any_of(offers.begin(), offers.end(),
                                      [&](const StubOffer& offer) { return offer.stub == target; });
  if (is_offered) return target;
  if (rule == "right_hand") return rightmost(offers, stubs, T_map_body);
  if (rule == "random") return any(offers);
  throw std::invalid_argument("'" + rule + "' is no rule of exploration");
}

}  // namespace adit

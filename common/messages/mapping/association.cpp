// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "common/messages/mapping/association.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <string_view>
#include <vector>

#include "common/messages/fields/mapping_fields.hpp"
#include "common/messages/planar_geometry.hpp"

namespace adit {
namespace {

using Action = Association::Action;

static_assert(static_cast<int>(Action::kProposed) == association_t::ACTION_PROPOSED);
static_assert(static_cast<int>(Action::kRevised) == association_t::ACTION_REVISED);
static_assert(Association::kNone == association_t::NONE);

constexpr std::size_t kPairsMax = 1000;

loop_closure_alternative_t to_message(const LoopClosureAlternative& alternative) {
  loop_closure_alternative_t message;
  message.older_map = alternative.older_map;
  set_pose(alternative.T_older_newer, message.T_older_newer);
  set_matrix(alternative.information, message.information);
  message.log_likelihood = alternative.log_likelihood;
  return message;
}

LoopClosureAlternative alternative_from(const loop_closure_alternative_t& message) {
  return {message.older_map, pose_from(message.T_older_newer), matrix_from(message.information),
          message.log_likelihood};
}

bool is_choice(std::int32_t chosen, const association_t& message) {
  return chosen >= association_t::NONE && chosen < message.n_alternatives;
}

std::string_view rejection_reason(const loop_closure_alternative_t& message,
                                  std::int32_t newer_map) {
  if (message.older_map < 0 || message.older_map >= newer_map)
    return "alternative is not an older map";
  return {};
}

std::string_view rejection_reason(const association_t& message) {
  if (const auto reason = implausible_field(message); !reason.empty()) return reason;
  if (!is_choice(message.chosen, message)) return "choice is not an alternative";
  if (!is_choice(message.previously_chosen, message)) return "choice is not an alternative";
  for (const loop_closure_alternative_t& alternative : message.alternatives) {
    const auto reason = rejection_reason(alternative, message.newer_map);
    if (!reason.empty()) return reason;
  }
  return {};
}

}  // namespace

association_t to_message(const Association& association) {
  const LoopClosure& loop_closure = association.loop_closure;
  association_t message;
  message.utime = association.utime;
  message.action = static_cast<std::int8_t>(association.action);
  message.loop_closure = loop_closure.id;
  message.newer_map = loop_closure.newer_map;
  message.n_alternatives = static_cast<std::int32_t>(loop_closure.alternatives.size());
  for (const LoopClosureAlternative& alternative : loop_closure.alternatives) {
    message.alternatives.push_back(to_message(alternative));
  }
  message.chosen = association.chosen;
  message.previously_chosen = association.previously_chosen;
  message.log_likelihood = association.log_likelihood;
  message.reason = association.reason;
  return message;
}

Result<Association> from_message(const association_t& message) {
  if (const auto reason = rejection_reason(message); !reason.empty()) return Rejected{reason};
  Association association;
  association.utime = message.utime;
  association.action = Action(message.action);
  association.loop_closure.id = message.loop_closure;
  association.loop_closure.newer_map = message.newer_map;
  for (const loop_closure_alternative_t& alternative : message.alternatives) {
    association.loop_closure.alternatives.push_back(alternative_from(alternative));
  }
  association.chosen = message.chosen;
  association.previously_chosen = message.previously_chosen;
  association.log_likelihood = message.log_likelihood;
  association.reason = message.reason;
  return association;
}

map_contradictions_t to_message(const MapContradictions& contradictions) {
  std::vector<MapContradiction> pairs = contradictions.pairs;
  std::stable_sort(pairs.begin(), pairs.end(),
                   [](const auto& a, const auto& b) { return a.evidence > b.evidence; });
  if (pairs.size() > kPairsMax) pairs.resize(kPairsMax);
  map_contradictions_t message;
  message.utime = contradictions.utime;
  message.revision = contradictions.revision;
  message.n_pairs = static_cast<std::int32_t>(pairs.size());
  for (const MapContradiction& pair : pairs) {
    message.older_maps.push_back(pair.older_map);
    message.newer_maps.push_back(pair.newer_map);
    message.evidence.push_back(pair.evidence);
  }
  return message;
}

Result<MapContradictions> from_message(const map_contradictions_t& message) {
  if (const auto reason = implausible_field(message); !reason.empty()) return Rejected{reason};
  const auto n = static_cast<std::size_t>(message.n_pairs);
  MapContradictions contradictions{message.utime, message.revision, {}};
  for (std::size_t i = 0; i < n; ++i) {
    const int older = message.older_maps[i];
    const int newer = message.newer_maps[i];
    if (older >= newer) return Rejected{"pair is not an older and a newer map"};
    contradictions.pairs.push_back({older, newer, message.evidence[i]});
  }
  return contradictions;
}

}  // namespace adit

// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "tools/map/association_table.hpp"

#include <array>
#include <cstdio>

#include "common/geometry/angle.hpp"
#include "common/sensing/seconds.hpp"

namespace adit {
namespace {

constexpr const char* kHeader =
    "time_s\tdecision\tclosure\tnewer_map\tolder_map\tchosen\tchosen_before\talternatives\t"
    "x_m\ty_m\ttheta_deg\tlog_likelihood\tlog_likelihood_of_all\treason\n";

template <class... Values>
std::string format(const char* pattern, Values... values) {
  std::array<char, 200> text{};
  std::snprintf(text.data(), text.size(), pattern, values...);
  return text.data();
}

std::string decision(const Association& a) {
  if (a.action == Association::Action::kProposed) {
    return a.chosen == Association::kNone ? "left out" : "closed";
  }
  if (a.chosen == Association::kNone) return "undone";
  return a.chosen_before == Association::kNone ? "redone" : "changed";
}

/// Counted from 1, the most likely first.
std::string choice(int chosen) {
  return chosen == Association::kNone ? "none" : std::to_string(chosen + 1);
}

/// The alternative that a line is about: what is chosen, or was, or might have been.
const ClosureAlternative& subject(const Association& a) {
  int index = 0;
  if (a.chosen_before != Association::kNone) index = a.chosen_before;
  if (a.chosen != Association::kNone) index = a.chosen;
  return a.closure.alternatives[static_cast<std::size_t>(index)];
}

std::string line(const Association& a) {
  const ClosureAlternative& alternative = subject(a);
  const Pose2& T = alternative.T_older_newer;
  return format("%.6f\t%s\t%d\t%d\t%d\t", seconds(a.utime), decision(a).c_str(), a.closure.id,
                a.closure.newer_map, alternative.older_map) +
         format("%s\t%s\t%zu\t", choice(a.chosen).c_str(), choice(a.chosen_before).c_str(),
                a.closure.alternatives.size()) +
         format("%.3f\t%.3f\t%.2f\t%.1f\t%.1f\t", T.x, T.y, rad_to_deg(T.theta),
                alternative.log_likelihood, a.log_likelihood) +
         a.reason + "\n";
}

}  // namespace

std::string association_table(const WholeMap& map) {
  std::string text = kHeader;
  for (const Association* association : map.associations) text += line(*association);
  return text;
}

}  // namespace adit

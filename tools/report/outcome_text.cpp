// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "tools/report/mission_facts.hpp"
#include "tools/report/text.hpp"

namespace adit {
namespace {

std::string is_or_are(std::size_t count) {
  return std::to_string(count) + (count == 1 ? " is" : " are");
}

/// Of the openings that nobody saw behind.
std::string unseen_text(const StubCounts& stubs) {
  std::string text;
  const auto add = [&](std::size_t count, const char* what) {
    if (count > 0) text += (text.empty() ? "" : ", ") + is_or_are(count) + what;
  };
  add(stubs.open - stubs.doubtful, " left open");
  add(stubs.doubtful, " given up, though nobody saw what blocks the way");
  add(stubs.blocked, " blocked");
  return text;
}

std::string openings_text(const MissionFacts& facts) {
  if (!facts.stubs || facts.stubs->found == 0) return "";
  const bool complete = facts.last && facts.last->complete;
  const std::string found = counted(facts.stubs->found, "opening");
  const std::string unseen = unseen_text(*facts.stubs);
  if (!complete) return " Of " + found + ", " + (unseen.empty() ? "all are closed" : unseen) + ".";
  return " It explored the mine: every one of the " + found +
         " that it saw is closed, with evidence" + (unseen.empty() ? "." : "; " + unseen + ".");
}

std::string end_text(const MissionFacts& facts) {
  const std::string away = metres(facts.from_start_m) + " from where it started";
  if (!facts.last) {
    return "The log does not say how the mission stood (it has no PHASE); the robot was " + away +
           " when it ended.";
  }
  switch (facts.last->outcome) {
    case MissionOutcome::kHome:
      return "The robot came home.";
    case MissionOutcome::kStopped:
      return "The mission was stopped by order; the robot stands " + away + ".";
    case MissionOutcome::kStranded:
      return "The robot did not come home: it stands " + away + ", and no way was found any more.";
    case MissionOutcome::kUnderWay:
      return std::string("The log ends while the mission is under way (") +
             name_of(facts.last->phase) + "); the robot was " + away + ".";
  }
  return "";
}

}  // namespace

std::string outcome_text(const MissionFacts& facts) {
  std::string text = end_text(facts) + openings_text(facts);
  if (facts.failure && !facts.failure->empty()) {
    text += " The simulated run failed: " + sentence(*facts.failure);
  }
  return text;
}

}  // namespace adit

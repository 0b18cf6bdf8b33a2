// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "procs/mission/recovery.hpp"

#include <algorithm>
#include <limits>

namespace adit {
namespace {

constexpr int kRejectionsMax = 6;      // per target, whatever was tried
constexpr int kObservedMin = 2;        // a verdict rests on scans from two poses
constexpr double kApproachMinM = 1.3;  // the robot stops a metre before

using Action = Recovery::Action;
using Evidence = Recovery::Evidence;

struct Situation {
  int rejections = 0;
  bool is_uncertain = true;
  bool returning_home = false;
  double reached_m = 0.0;
  Recovery::Options options;
};

bool always(const Situation&) { return true; }
bool is_decided(const Situation& s) { return s.rejections >= kRejectionsMax || !s.is_uncertain; }
bool can_scan_beside(const Situation& s) { return !s.returning_home && s.options.can_back_off; }
bool can_approach(const Situation& s) { return !s.returning_home && s.reached_m >= kApproachMinM; }
bool is_first_without_path_back(const Situation& s) {
  return s.rejections < 2 && !s.options.can_back_off;
}
bool can_back_off(const Situation& s) {
  return s.options.can_back_off && !s.options.is_short_cut_home;
}

bool has_other_laser(const Situation& s) { return s.options.has_other_laser; }

constexpr unsigned bit(Evidence evidence) { return 1U << static_cast<unsigned>(evidence); }
constexpr unsigned kAnyEvidence = ~0U;
constexpr unsigned kDriveFailed = bit(Evidence::kDriveFailed);
constexpr unsigned kNotObserved = bit(Evidence::kUnobserved) | bit(Evidence::kNarrow);
constexpr int kUnlimited = std::numeric_limits<int>::max();

struct Rule {
  Action action;
  unsigned evidence;
  bool (*applies)(const Situation&);
  int uses_max;         // per target
  bool rejoin_instead;  // where the traversed path leads to the target
};

// The first row applies whose evidence, condition and number of uses hold. The last one always
// does.
// clang-format off
constexpr std::array<Rule, Recovery::kRules> kTable{{
    // action                 evidence      condition                   uses        rejoin instead
    {Action::kAbandon,        kAnyEvidence, is_decided,                 kUnlimited, false},
    {Action::kRescan,         kDriveFailed, always,                     1,          false},
    {Action::kScanBeside,     kNotObserved, can_scan_beside,            1,          true},
    {Action::kApproach,       kNotObserved, can_approach,               1,          true},
    {Action::kScanOtherLaser, kNotObserved, has_other_laser,            1,          true},
    {Action::kRescan,         kAnyEvidence, is_first_without_path_back, kUnlimited, false},
    {Action::kBackOff,        kAnyEvidence, can_back_off,               2,          true},
    {Action::kAbandon,        kAnyEvidence, always,                     kUnlimited, false},
}};
// clang-format on

}  // namespace

bool Recovery::set_target(FrontierId frontier, bool returning_home) {
  if (frontier == frontier_ && returning_home == returning_home_) return false;
  frontier_ = frontier;
  returning_home_ = returning_home;
  reset();
  return true;
}

void Recovery::reset() { attempts_ = {}; }

bool Recovery::is_uncertain() const {
  return attempts_.observed < kObservedMin || narrow_passages_.is_doubtful(frontier_);
}

/// Only actions that were limited change; the number of rejections limits all.
void Recovery::note_missed_viewpoint() {
  if (!attempts_.last_row) return;
  --attempts_.uses[*attempts_.last_row];
  if (kTable[*attempts_.last_row].action == Action::kBackOff) --attempts_.back_offs;
  attempts_.last_row.reset();
}

Recovery::Action Recovery::choose(const Rejection& rejection, const Options& options) {
  ++attempts_.rejections;
  if (rejection.evidence == Evidence::kObserved) {
    ++attempts_.observed;
    narrow_passages_.add_blocked(frontier_, rejection.reached_m);
  } else if (rejection.evidence == Evidence::kNarrow) {
    narrow_passages_.add_doubt(frontier_, {rejection.reached_m, rejection.T_odom_end});
  }
  attempts_.reached_m = std::max(attempts_.reached_m, rejection.reached_m);
  attempts_.evidence += (attempts_.evidence.empty() ? "" : " Again: ") + rejection.reason;

  const Situation situation{attempts_.rejections, is_uncertain(), returning_home_,
                            rejection.reached_m, options};
  for (std::size_t row = 0; row < kTable.size(); ++row) {
    const Rule& rule = kTable[row];
    if ((rule.evidence & bit(rejection.evidence)) == 0 || !rule.applies(situation)) continue;
    if (attempts_.uses[row] == rule.uses_max) continue;
    ++attempts_.uses[row];
    attempts_.last_row = row;
    if (rule.action == Action::kBackOff) ++attempts_.back_offs;
    return rule.rejoin_instead && options.can_rejoin ? Action::kRejoin : rule.action;
  }
  return Action::kAbandon;
}

}  // namespace adit

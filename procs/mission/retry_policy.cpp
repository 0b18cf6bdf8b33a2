// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "procs/mission/retry_policy.hpp"

#include <algorithm>
#include <utility>

namespace adit {
namespace {

constexpr int kRejectionsMax = 6;  // whatever was tried in between
constexpr int kObservedMin = 2;    // a verdict comes from two poses
constexpr int kBackOffsMax = 2;
constexpr double kApproachMinM = 1.0;

}  // namespace

bool RetryPolicy::set_target(int frontier, bool returning_home) {
  if (frontier == frontier_ && returning_home == homeward_) return false;
  *this = {};
  frontier_ = frontier;
  homeward_ = returning_home;
  return true;
}

void RetryPolicy::note_progress() {
  const int frontier = frontier_;
  const bool returning_home = homeward_;
  *this = {};
  frontier_ = frontier;
  homeward_ = returning_home;
}

bool RetryPolicy::is_uncertain() const { return observed_ < kObservedMin || narrow_; }

RetryPolicy::Action RetryPolicy::reject(std::int64_t utime, double reached_m,
                                        const std::string& reason, Evidence evidence,
                                        bool may_back_off) {
  ++rejections_;
  if (evidence == Evidence::kObserved) ++observed_;
  if (evidence == Evidence::kNarrow) narrow_ = true;
  utime_ = utime;
  reached_m_ = std::max(reached_m_, reached_m);
  evidence_ += (evidence_.empty() ? "" : " Again: ") + reason;
  if (rejections_ >= kRejectionsMax || !is_uncertain()) return Action::kAbandon;
  if (evidence == Evidence::kDriveFailed && !rescanned_after_drive_) {
    rescanned_after_drive_ = true;
    return Action::kRescan;
  }
  if (evidence == Evidence::kUnobserved || evidence == Evidence::kNarrow) {
    const Action action = choose_observation(reached_m, may_back_off);
    if (action != Action::kBackOff) return action;
  }
  if (!may_back_off) return rejections_ < 2 ? Action::kRescan : Action::kAbandon;
  if (back_offs_ == kBackOffsMax) return Action::kAbandon;
  ++back_offs_;
  return Action::kBackOff;
}

/// On the way home the own track is the next thing.
RetryPolicy::Action RetryPolicy::choose_observation(double reached_m, bool may_back_off) {
  if (!homeward_ && may_back_off && !std::exchange(scanned_beside_, true))
    return Action::kScanBeside;
  if (!homeward_ && reached_m >= kApproachMinM && !std::exchange(approached_, true)) {
    return Action::kApproach;
  }
  return std::exchange(scanned_other_side_, true) ? Action::kBackOff : Action::kScanOtherLaser;
}

}  // namespace adit

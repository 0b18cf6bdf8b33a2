// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "procs/mission/attempt.hpp"

#include <algorithm>
#include <utility>

namespace adit {
namespace {

constexpr int kRefusalsMax = 6;  // whatever was tried in between
constexpr int kSeenMin = 2;      // a verdict comes from two poses
constexpr int kBackOffsMax = 2;
constexpr double kWorthGoingM = 1.0;

}  // namespace

bool Attempt::aim_at(int stub, bool homeward) {
  if (stub == stub_ && homeward == homeward_) return false;
  *this = {};
  stub_ = stub;
  homeward_ = homeward;
  return true;
}

void Attempt::got_on() {
  const int stub = stub_;
  const bool homeward = homeward_;
  *this = {};
  stub_ = stub;
  homeward_ = homeward;
}

bool Attempt::is_doubtful() const { return seen_ < kSeenMin || narrow_; }

Attempt::Next Attempt::refuse(std::int64_t utime, double reached_m, const std::string& reason,
                              Evidence evidence, bool may_back_off) {
  ++refusals_;
  if (evidence == Evidence::kSeen) ++seen_;
  if (evidence == Evidence::kNarrow) narrow_ = true;
  utime_ = utime;
  reached_m_ = std::max(reached_m_, reached_m);
  evidence_ += (evidence_.empty() ? "" : " Again: ") + reason;
  if (refusals_ >= kRefusalsMax || !is_doubtful()) return Next::kGiveUp;
  if (evidence == Evidence::kDrive && !drove_again_) {
    drove_again_ = true;
    return Next::kLookAgain;
  }
  if (evidence == Evidence::kUnseen || evidence == Evidence::kNarrow) {
    const Next next = see_more(reached_m, may_back_off);
    if (next != Next::kBackOff) return next;
  }
  if (!may_back_off) return refusals_ < 2 ? Next::kLookAgain : Next::kGiveUp;
  if (back_offs_ == kBackOffsMax) return Next::kGiveUp;
  ++back_offs_;
  return Next::kBackOff;
}

/// On the way home the own track is the next thing.
Attempt::Next Attempt::see_more(double reached_m, bool may_back_off) {
  if (!homeward_ && may_back_off && !std::exchange(looked_beside_, true)) return Next::kBeside;
  if (!homeward_ && reached_m >= kWorthGoingM && !std::exchange(went_nearer_, true)) {
    return Next::kNearer;
  }
  return std::exchange(looked_round_, true) ? Next::kBackOff : Next::kOtherLaser;
}

}  // namespace adit

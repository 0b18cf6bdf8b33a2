// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "procs/mission/attempt.hpp"

#include <algorithm>

namespace adit {
namespace {

constexpr int kRefusalsMax = 4;  // whatever was tried in between

}  // namespace

void Attempt::aim_at(int stub, bool homeward) {
  if (stub == stub_ && homeward == homeward_) return;
  *this = {};
  stub_ = stub;
  homeward_ = homeward;
}

void Attempt::got_on() {
  const int stub = stub_;
  const bool homeward = homeward_;
  *this = {};
  stub_ = stub;
  homeward_ = homeward;
}

Attempt::Next Attempt::refuse(std::int64_t utime, double reached_m, const std::string& reason,
                              bool unseen, bool may_back_off) {
  ++refusals_;
  utime_ = utime;
  reached_m_ = std::max(reached_m_, reached_m);
  evidence_ += (evidence_.empty() ? "" : " Again: ") + reason;
  if (refusals_ >= kRefusalsMax) return Next::kGiveUp;
  if (unseen && !looked_round_) {
    looked_round_ = true;
    return Next::kOtherLaser;
  }
  if (!backed_off_) {
    backed_off_ = true;
    if (may_back_off) return Next::kBackOff;
    return refusals_ < 2 ? Next::kLookAgain : Next::kGiveUp;
  }
  return Next::kGiveUp;
}

}  // namespace adit

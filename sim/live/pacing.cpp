// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "sim/live/pacing.hpp"

#include <algorithm>
#include <cmath>

namespace adit {
namespace {

constexpr std::int64_t kCatchUpMaxUs = 100'000;  // a longer delay is not caught up
constexpr std::int64_t kPollPeriodUs = 100'000;  // an answer usually ends the wait earlier

}  // namespace

Pacing::Pacing(const PacingParams& params)
    : factor_(params.factor), ahead_max_us_(std::llround(params.ahead_max_s * 1e6)) {
  for (const std::string& stage : params.wait_for) stages_[stage];
  if (params.outage_max_s) outage_max_us_ = std::llround(*params.outage_max_s * 1e6);
}

void Pacing::done(std::string_view stage, std::int64_t utime) {
  const auto found = stages_.find(stage);
  if (found == stages_.end()) return;
  const auto excluded_utime = found->second.excluded_utime;
  if (excluded_utime && utime <= *excluded_utime) return;  // sent before the fault
  found->second = {std::max(utime, found->second.done_utime.value_or(utime)), std::nullopt, false,
                   std::nullopt};
}

void Pacing::exclude(std::string_view stage, std::int64_t utime) {
  const auto found = stages_.find(stage);
  if (found == stages_.end()) return;
  found->second.excluded_utime = utime;
  found->second.blocks_since_us.reset();
}

Pacing::Decision Pacing::decide(std::int64_t utime, std::int64_t wall_us) {
  if (must_wait_for_stages(utime, wall_us)) {
    return {Decision::Kind::kWaitForStages, kPollPeriodUs};
  }
  const std::int64_t wait_us = until_due_us(utime, wall_us);
  if (wait_us > 0) return {Decision::Kind::kWaitForClock, wait_us};
  return {};
}

bool Pacing::keeps_up(const Stage& stage, std::int64_t utime) const {
  if (stage.excluded_utime) {
    return !outage_max_us_ || utime - *stage.excluded_utime <= *outage_max_us_;
  }
  return stage.done_utime && utime - *stage.done_utime <= ahead_max_us_;
}

bool Pacing::must_wait_for_stages(std::int64_t utime, std::int64_t wall_us) {
  bool wait = false;
  for (auto& [name, stage] : stages_) {
    if (keeps_up(stage, utime)) continue;
    wait = true;
    if (!stage.blocks_since_us) stage.blocks_since_us = wall_us;
  }
  return wait;
}

std::int64_t Pacing::until_due_us(std::int64_t utime, std::int64_t wall_us) {
  if (!factor_) return 0;
  if (!origin_) origin_ = {utime, wall_us};
  const double since_origin_us = static_cast<double>(utime - origin_->utime) / *factor_;
  const std::int64_t due_us = origin_->wall_us + std::llround(since_origin_us);
  if (wall_us > due_us + kCatchUpMaxUs) origin_ = {utime, wall_us};
  return std::max<std::int64_t>(0, due_us - wall_us);
}

std::vector<std::string> Pacing::newly_timed_out(std::int64_t wall_us) {
  std::vector<std::string> names;
  for (auto& [name, stage] : stages_) {
    if (stage.reported || !stage.blocks_since_us) continue;
    if (wall_us - *stage.blocks_since_us < kStageTimeoutUs) continue;
    stage.reported = true;
    names.push_back(name);
  }
  return names;
}

}  // namespace adit

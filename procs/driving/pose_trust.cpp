// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "procs/driving/pose_trust.hpp"

#include <cmath>

#include "common/sensing/seconds.hpp"

namespace adit {

void PoseTrust::add_match(std::int64_t utime, ScanMatch::Status status) {
  if (status == ScanMatch::Status::kMatched) lost_utime_.reset();
  if (status == ScanMatch::Status::kLost && !lost_utime_) lost_utime_ = utime;
}

std::optional<std::string> PoseTrust::doubt(std::int64_t utime,
                                            const std::optional<std::int64_t>& pose_utime) const {
  const auto seconds_since = [utime](std::int64_t then) { return seconds(utime - then); };
  if (!pose_utime) return "no pose has come yet";
  if (seconds_since(*pose_utime) > params_.pose_age_max_s) return "the newest pose is too old";
  if (seconds_since(*pose_utime) < -params_.pose_age_max_s) {
    return "the newest pose is of a time to come";
  }
  // A time that went back counts as well: since when it is lost is not known then.
  if (lost_utime_ && std::abs(seconds_since(*lost_utime_)) > params_.lost_max_s) {
    return "scan matching is lost";
  }
  return std::nullopt;
}

}  // namespace adit

// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "procs/scan_assembly/held_clouds.hpp"

#include <algorithm>

namespace adit {

void HeldClouds::add(const Cloud& cloud, std::int64_t utime) {
  sent_.push_back({utime, cloud});
  if (sent_.size() > kMax) sent_.pop_front();
}

const Cloud* HeldClouds::missed(const CloudRequest& request, std::int64_t utime) const {
  const auto is_missed = [&](const Sent& sent) {
    const std::int64_t end = sent.cloud.utime;
    return utime - sent.utime >= kOnItsWayUs && end > request.after_utime &&
           std::ranges::find(request.have_utime, end) == request.have_utime.end();
  };
  const auto found = std::find_if(sent_.rbegin(), sent_.rend(), is_missed);
  return found == sent_.rend() ? nullptr : &found->cloud;
}

}  // namespace adit

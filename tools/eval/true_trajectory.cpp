// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "tools/eval/true_trajectory.hpp"

#include <stdexcept>

#include "common/bus/channels.hpp"
#include "common/bus/event_source.hpp"
#include "common/messages/codec.hpp"
#include "common/messages/pose.hpp"

namespace adit {
Trajectory read_truth(const std::filesystem::path& log) {
  LogFile events(log);
  Trajectory trajectory;
  while (const auto event = events.next()) {
    if (event->channel != channels::kTruth) continue;
    const auto message = decode<pose_t>(event->data);
    if (!message) continue;
    const auto pose = from_message(*message);
    if (!pose || (!trajectory.empty() && pose->utime <= trajectory.back().utime)) continue;
    trajectory.push_back({pose->utime, pose->T_odom_body});
  }
  if (trajectory.empty()) throw std::runtime_error(log.string() + " holds no truth");
  return trajectory;
}

}  // namespace adit

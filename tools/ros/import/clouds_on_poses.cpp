// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "tools/ros/import/clouds_on_poses.hpp"

#include <algorithm>
#include <iterator>
#include <utility>

#include "common/bus/channels.hpp"
#include "common/bus/typed_messages.hpp"
#include "common/messages/codec.hpp"
#include "common/messages/mapping/cloud.hpp"

namespace adit {
namespace {

constexpr std::int64_t kPosesUs = 10'000'000;  // that are kept
constexpr std::int64_t kBehindUs =
    1'000'000;                          // a scan may be behind the last pose, or before the first
constexpr std::size_t kHeldMax = 2000;  // fragments
constexpr std::size_t kPosesQueued = 100;

StampedPose blend(const StampedPose& a, const StampedPose& b, std::int64_t utime) {
  const double share =
      static_cast<double>(utime - a.utime) / static_cast<double>(b.utime - a.utime);
  StampedPose pose = a;
  pose.T_odom_body.x += share * (b.T_odom_body.x - a.T_odom_body.x);
  pose.T_odom_body.y += share * (b.T_odom_body.y - a.T_odom_body.y);
  pose.T_odom_body.theta = wrap_angle(a.T_odom_body.theta +
                                      share * angle_diff(b.T_odom_body.theta, a.T_odom_body.theta));
  pose.z_m += share * (b.z_m - a.z_m);
  return pose;
}

}  // namespace

void CloudsOnPoses::subscribe_to(Bus& bus) {
  subscribe<pose_t>(bus, channels::kPose, Delivery::queued(kPosesQueued),
                    [this](const StampedPose& pose) {
                      poses_[pose.utime] = pose;
                      poses_.erase(poses_.begin(), poses_.lower_bound(pose.utime - kPosesUs));
                    });
}

std::optional<StampedPose> CloudsOnPoses::pose_at(std::int64_t utime) const {
  const auto after = poses_.lower_bound(utime);
  if (after == poses_.end()) {
    if (!ended_ || poses_.empty() || utime - poses_.rbegin()->first > kBehindUs)
      return std::nullopt;
    return poses_.rbegin()->second;
  }
  if (after == poses_.begin()) {
    if (after->first - utime > kBehindUs) return std::nullopt;
    return after->second;
  }
  return blend(std::prev(after)->second, after->second, utime);
}

void CloudsOnPoses::hold(const LogEventView& event) {
  const auto message = decode<cloud_t>(event.data);
  if (!message || held_.size() >= kHeldMax) {
    ++without_pose_;
    return;
  }
  held_.push_back(
      {message->utime,
       {event.utime, std::string(event.channel), {event.data.begin(), event.data.end()}}});
}

/// The next scan of which the pose is known.
std::optional<LogEventView> CloudsOnPoses::placed() {
  while (!held_.empty()) {
    const std::int64_t utime = held_.front().cloud_utime;
    const auto pose = pose_at(utime);
    const bool is_known = ended_ || (!poses_.empty() && poses_.rbegin()->first >= utime);
    if (!pose && !is_known) return std::nullopt;
    last_ = std::move(held_.front().event);
    held_.pop_front();
    if (!pose) {
      ++without_pose_;
      continue;
    }
    cloud_t message = *decode<cloud_t>(last_.data);
    message.T_odom_level[0] = pose->T_odom_body.x;
    message.T_odom_level[1] = pose->T_odom_body.y;
    message.T_odom_level[2] = pose->T_odom_body.theta;
    message.z_odom_m = pose->z_m;
    last_.data = encode(message);
    last_.utime = std::max(utime_, last_.utime);
    return LogEventView{last_.utime, last_.channel, last_.data};
  }
  return std::nullopt;
}

std::optional<LogEventView> CloudsOnPoses::next() {
  while (true) {
    if (const auto cloud = placed()) return cloud;
    if (ended_) return std::nullopt;
    const auto event = source_.next();
    if (!event) {
      ended_ = true;
    } else if (event->channel == channels::kCloud) {
      hold(*event);
    } else {
      utime_ = event->utime;
      return event;
    }
  }
}

}  // namespace adit

// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <deque>
#include <map>
#include <optional>
#include <vector>

#include "common/bus/bus.hpp"
#include "common/bus/log/event_source.hpp"
#include "common/bus/log/lcm_log.hpp"
#include "common/messages/mapping/odometry.hpp"

namespace adit {

/// The events of an imported log, in which each 3D scan has the pose that scan matching finds on a
/// bus while they are replayed, in place of that by the odometry of the log. A scan waits for the
/// first pose after it. Those that get none are left out and counted.
class CloudsOnPoses final : public EventSource {
 public:
  /// `source` must outlive this.
  explicit CloudsOnPoses(EventSource& source) : source_(source) {}

  /// Follows POSE on this bus, which must outlive this.
  void subscribe_to(Bus& bus);

  std::optional<LogEventView> next() override;
  [[nodiscard]] std::size_t size() const override { return source_.size(); }
  [[nodiscard]] std::size_t without_pose() const { return without_pose_; }

 private:
  void hold(const LogEventView& event);
  /// The pose at a time between two that are known, or within a second behind the last one at the
  /// end.
  [[nodiscard]] std::optional<StampedPose> pose_at(std::int64_t utime) const;
  std::optional<LogEventView> placed();

  struct Held {
    std::int64_t cloud_utime = 0;
    LogEvent event;
  };

  EventSource& source_;
  std::map<std::int64_t, StampedPose> poses_;  ///< of the last seconds
  std::deque<Held> held_;
  LogEvent last_;  ///< that was returned
  std::int64_t utime_ = 0;
  bool ended_ = false;
  std::size_t without_pose_ = 0;
};

}  // namespace adit

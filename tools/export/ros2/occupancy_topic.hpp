// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "common/bus/log/lcm_log.hpp"
#include "common/bus/memory_bus.hpp"
#include "tools/export/ros2/ros2_messages.hpp"
#include "viewer/scene/scene.hpp"

namespace adit {

/// The map of a log as the viewer composes it.
class OccupancyTopic {
 public:
  explicit OccupancyTopic(const SceneParameters& parameters);

  /// Events in order of time. The map is returned every ten seconds, if it has changed.
  std::optional<ros2::OccupancyCells> play(const LogEventView& event);
  /// The map at the end, if it has changed since it was returned.
  std::optional<ros2::OccupancyCells> last() { return newest(board_.take_changed()); }

 private:
  [[nodiscard]] std::optional<ros2::OccupancyCells> newest(
      const std::vector<TopicBoard::Update>& updates) const;

  MemoryBus bus_;
  TopicBoard board_;
  Scene scene_;
  TopicId map_ = 0;
  std::int64_t next_utime_ = 0;
};

}  // namespace adit

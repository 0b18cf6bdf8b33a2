// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <memory>
#include <utility>
#include <vector>

#include "common/bus/log/event_source.hpp"
#include "common/bus/memory_bus.hpp"
#include "viewer/scene/scene.hpp"
#include "viewer/scene/scene_parameters.hpp"
#include "viewer/server/protocol.hpp"
#include "viewer/server/topic_board.hpp"

namespace adit {

/// Plays the logs of one mission to a scene: at a speed, paused, from any time. Wall time is that
/// of the caller.
class LogPlayer {
 public:
  /// Throws std::runtime_error if a log cannot be read or all are empty.
  LogPlayer(const std::vector<std::filesystem::path>& logs, const SceneParameters& parameters);

  /// First and last time [µs since the epoch].
  [[nodiscard]] std::pair<std::int64_t, std::int64_t> time_range() const;
  [[nodiscard]] std::int64_t now_utime() const { return now_utime_; }
  /// Valid until `advance` returns true.
  [[nodiscard]] TopicBoard& board() { return *board_; }

  foxglove_protocol::PlaybackState control(const foxglove_protocol::PlaybackControl& control,
                                           std::int64_t wall_us);
  [[nodiscard]] foxglove_protocol::PlaybackState state() const;

  /// Plays what is due, for kWorkUs of wall time at most. Returns whether there is another board:
  /// after a step back in time everything is read again.
  bool advance(std::int64_t wall_us);

 private:
  void restart();
  [[nodiscard]] std::int64_t target_utime(std::int64_t wall_us) const;
  void play_until(std::int64_t utime);

  SceneParameters parameters_;
  std::vector<std::unique_ptr<LogFile>> logs_;
  std::vector<LogEventView> events_;  ///< of all logs, by time
  std::size_t next_ = 0;
  std::unique_ptr<MemoryBus> bus_;
  std::unique_ptr<TopicBoard> board_;
  std::unique_ptr<Scene> scene_;
  std::int64_t now_utime_ = 0;
  // Playback: the time `from_utime_` belongs to the wall time `from_wall_us_`.
  bool playing_ = true;
  double speed_ = 1.0;
  std::int64_t from_utime_ = 0;
  std::int64_t from_wall_us_ = 0;
  bool behind_ = false;  ///< the target is not reached yet
};

}  // namespace adit

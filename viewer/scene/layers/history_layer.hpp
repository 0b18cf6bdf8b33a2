// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <deque>
#include <string>
#include <vector>

#include "common/messages/mapping/odometry.hpp"
#include "viewer/scene/layers/mission_layer.hpp"
#include "viewer/scene/map_frame.hpp"
#include "viewer/server/topic_board.hpp"

namespace adit {

/// A row a second about the robot, /history, in chunks of kRowsPerChunk seconds. A chunk is sent
/// with each row that it gets; all are sent again when the pose graph moves the path.
class HistoryLayer {
 public:
  static constexpr std::size_t kRowsPerChunk = 30;
  static constexpr std::size_t kChunksMax = TopicBoard::kAppendedMax;

  /// All must outlive this.
  HistoryLayer(TopicBoard& board, const MapFrame& frame, const MissionLayer& mission);
  HistoryLayer(const HistoryLayer&) = delete;
  HistoryLayer& operator=(const HistoryLayer&) = delete;

  /// Adds a row if the last one is a second old.
  void add_pose(const StampedPose& pose);
  /// The pose graph has changed.
  void update_poses();

 private:
  struct Row {
    std::int64_t utime = 0;
    AnchoredPose T_body;
    double speed_m_s = 0.0;
    double battery_share = 0.0;
    double position_sd_m = 0.0;
    double methane_share = 0.0;
    Phase phase = Phase::kWaiting;
  };
  struct Chunk {
    std::size_t number = 0;
    std::vector<Row> rows = {};
    LevelPose T_map_sent = {};  ///< of its last row, when it was sent
  };

  void send(Chunk& chunk);

  TopicBoard& board_;
  const MapFrame& frame_;
  const MissionLayer& mission_;
  TopicId topic_ = 0;
  std::deque<Chunk> chunks_;
};

}  // namespace adit

// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "common/types/planned_path.hpp"
#include "viewer/scene/anchored_path.hpp"
#include "viewer/scene/map_frame.hpp"
#include "viewer/server/topic_board.hpp"

namespace adit {

/// The path driven so far, /trajectory, and the planned one, /path.
class PathLayer {
 public:
  /// All must outlive this.
  PathLayer(TopicBoard& board, const MapFrame& frame, const AnchoredPath& driven);
  PathLayer(const PathLayer&) = delete;
  PathLayer& operator=(const PathLayer&) = delete;

  void set_planned(const PlannedPath& path);
  /// The driven path or its pose in map has changed.
  void set_changed(std::int64_t utime) { board_.set_changed(trajectory_topic_, utime); }

 private:
  [[nodiscard]] std::string trajectory_message() const;
  [[nodiscard]] std::string path_message() const;

  TopicBoard& board_;
  const MapFrame& frame_;
  const AnchoredPath& driven_;
  TopicId trajectory_topic_ = 0;
  TopicId path_topic_ = 0;
  std::optional<PlannedPath> planned_;
};

}  // namespace adit

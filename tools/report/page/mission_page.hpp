// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "common/bus/bus.hpp"
#include "tools/report/mission_statistics.hpp"
#include "tools/report/page/topic_recorder.hpp"
#include "viewer/scene/scene.hpp"

namespace adit {

/// Makes mission.html: replays a mission through the scene of the viewer, keeps its topics at
/// bounded rates, and puts the page of the viewer around them.
class MissionPage {
 public:
  /// `bus` must outlive this. `page` is the page of the viewer as it was built.
  MissionPage(Bus& bus, const Lasers& lasers, std::string page);

  /// Must be called repeatedly during the replay, with the bus time.
  void record(std::int64_t utime);

  /// The page with everything recorded; at the end of the log. `grid` may be null.
  std::string html(const MissionRecords& records, const MissionStatistics& statistics,
                   const MissionMap& map, const OccupancyGrid* grid, const std::string& title,
                   const std::vector<std::string>& warnings);

 private:
  std::string page_;
  TopicBoard board_;
  Scene scene_;
  TopicId summary_;
  TopicRecorder recorder_{board_};
  std::int64_t recorded_utime_ = 0;
};

}  // namespace adit

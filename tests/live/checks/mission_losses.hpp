// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <filesystem>
#include <vector>

#include "common/types/local_map.hpp"

namespace adit::test {

/// A local map or a 3D scan, and when it was last whole on its channel.
struct AnnouncedItem {
  std::int32_t id = 0;
  double at_s = 0.0;  ///< since the mission began
  double before_log_end_s =
      0.0;  ///< of the log that has it: of a life that was cut off, its last words
};

/// What was announced on LOCAL_MAP, POSE_GRAPH and CLOUD in the course of a mission.
struct Announced {
  std::vector<LocalMap> maps;            ///< the newest of each id, in order of ids
  std::vector<AnnouncedItem> map_times;  ///< of these
  std::vector<AnnouncedItem> scans;      ///< each once
  int graph_nodes = 0;                   ///< of the last graph
  double distance_from_start_m = 0.0;    ///< of the true body from where it began, at the end
};

/// Of the lives of a mission, in order of time; those without a byte are passed over. Throws
/// std::runtime_error for what is no log.
Announced announced_in(const std::vector<std::filesystem::path>& logs);

/// What of it the journals of the mission do not have.
struct MissionLosses {
  std::vector<AnnouncedItem> maps;   ///< also those that the last graph lacks
  std::vector<AnnouncedItem> scans;  ///< of which no point is in the volume
};

/// Throws std::runtime_error for a journal that is not there.
MissionLosses losses(const Announced& announced, const std::filesystem::path& map_journal,
                     const std::filesystem::path& volume_journal);

}  // namespace adit::test

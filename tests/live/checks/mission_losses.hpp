// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <filesystem>
#include <vector>

#include "common/types/local_map.hpp"

namespace adit::test {

/// Time at which a local map or a 3D scan was last complete on its channel.
struct PublishedItem {
  std::int32_t id = 0;
  double at_s = 0.0;              ///< since the start of the mission
  double before_log_end_s = 0.0;  ///< before the end of its log, which can end with a power loss
};

/// Data published on LOCAL_MAP, POSE_GRAPH and CLOUD during a mission.
struct PublishedData {
  std::vector<LocalMap> maps;            ///< the newest per id, in order of ids
  std::vector<PublishedItem> map_times;  ///< of `maps`
  std::vector<PublishedItem> scans;      ///< in order of ids
  int graph_nodes = 0;                   ///< of the last pose graph
  double distance_from_start_m = 0.0;    ///< of the true body at the end
};

/// Reads the logs of a mission, in order of time; empty logs are skipped. Throws std::runtime_error
/// for a file that is not a log.
PublishedData published_in(const std::vector<std::filesystem::path>& logs);

/// Published data that the journals of the mission do not contain.
struct MissionLosses {
  std::vector<PublishedItem> maps;   ///< also those missing in the last pose graph
  std::vector<PublishedItem> scans;  ///< without any point in the volume
};

/// Throws std::runtime_error if a journal is missing.
MissionLosses losses(const PublishedData& published, const std::filesystem::path& map_journal,
                     const std::filesystem::path& volume_journal);

}  // namespace adit::test

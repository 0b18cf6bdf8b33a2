// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "common/bus/memory_bus.hpp"
#include "common/bus/node/stage_bus.hpp"
#include "common/records/hazard.hpp"
#include "common/sensing/laser_mount.hpp"
#include "common/types/cloud_match.hpp"
#include "common/types/exploration.hpp"
#include "common/types/vehicle.hpp"
#include "tools/report/mission_map.hpp"
#include "tools/report/records/log_info.hpp"
#include "tools/report/records/map_record.hpp"
#include "tools/survey/input/cloud_store.hpp"

namespace adit {

/// What the logs of a mission tell about the mine: local maps with their pose graph, 3D scans
/// without their misses, and the last state of the exploration. Neither copied nor moved, since its
/// parts refer to each other.
class SurveyInput {
 public:
  /// Reads the logs. Throws std::runtime_error if a log cannot be read, or if they have no map or
  /// no 3D scan. `scratch`: folder for a temporary file.
  SurveyInput(std::vector<std::filesystem::path> logs,
              const std::function<void(double)>& progress = {},
              const std::filesystem::path& scratch = std::filesystem::temp_directory_path());
  SurveyInput(const SurveyInput&) = delete;
  SurveyInput& operator=(const SurveyInput&) = delete;

  [[nodiscard]] const LogInfo& log_info() const { return log_info_; }
  /// Of the recorded configuration, or the default.
  [[nodiscard]] const Vehicle& vehicle() const { return vehicle_; }
  [[nodiscard]] const MissionMap& map() const { return *map_; }
  /// 3D scans in the order of the log: scan i has the number i + 1, as in the report.
  [[nodiscard]] const CloudStore& clouds() const { return clouds_; }
  /// Matches of 3D scans, in the order of the log.
  [[nodiscard]] const std::vector<CloudMatch>& cloud_matches() const { return cloud_matches_; }
  /// Of the recorded configuration; nothing if the log has none.
  [[nodiscard]] const std::optional<Lasers>& lasers() const { return lasers_; }
  /// Observations of hazards, in the order of the log.
  [[nodiscard]] const std::vector<Hazard>& hazards() const { return hazards_; }
  /// Last EXPLORATION; nothing if the log has none.
  [[nodiscard]] const std::optional<ExplorationReport>& exploration() const { return exploration_; }
  /// T_world_body of the simulator; empty for a real robot.
  [[nodiscard]] const Trajectory& truth() const { return record_.truth(); }
  /// What the logs lack, one sentence each.
  [[nodiscard]] const std::vector<std::string>& warnings() const { return warnings_; }

 private:
  LogInfo log_info_;
  Vehicle vehicle_;
  MemoryBus memory_;
  StageBus bus_{memory_, StageBus::Measure::kNothing};
  MapRecord record_{bus_};
  std::unique_ptr<MissionMap> map_;
  CloudStore clouds_;
  std::vector<CloudMatch> cloud_matches_;
  std::optional<Lasers> lasers_;
  std::vector<Hazard> hazards_;
  std::optional<ExplorationReport> exploration_;
  std::vector<std::string> warnings_;
};

/// The logs of a mission: those of its folder, or the given ones. Throws std::runtime_error for a
/// folder without logs.
std::vector<std::filesystem::path> mission_logs(const std::vector<std::filesystem::path>& given);

}  // namespace adit

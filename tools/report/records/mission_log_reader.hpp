// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "common/bus/memory_bus.hpp"
#include "common/bus/node/node_host.hpp"
#include "common/records/event_record.hpp"
#include "procs/mapping/mapping_node.hpp"
#include "procs/volume_map/volume_map_node.hpp"
#include "tools/report/mission_statistics.hpp"
#include "tools/report/records/log_info.hpp"
#include "tools/report/records/map_record.hpp"
#include "tools/report/records/phase_record.hpp"
#include "tools/report/records/scan_record.hpp"
#include "tools/report/records/state_record.hpp"
#include "tools/report/report.hpp"

namespace adit {

/// Replays the logs of a mission to the records, to the stage volume_map and, with `remap`, to the
/// stage mapping.
class MissionLogReader {
 public:
  /// `log_info` must outlive this.
  MissionLogReader(const LogInfo& log_info, bool remap);
  MissionLogReader(const MissionLogReader&) = delete;
  MissionLogReader& operator=(const MissionLogReader&) = delete;

  void read(const ReportOptions& options, const std::function<void(double)>& progress);

  /// Unreadable CONFIGs and rejected messages, one sentence each.
  [[nodiscard]] std::vector<std::string> warnings() const;
  [[nodiscard]] MissionRecords records() const {
    return {log_info_, phases_, map_, scans_, events_, state_};
  }
  [[nodiscard]] MapRecord& map() { return map_; }
  [[nodiscard]] const VolumeMap& volume() const { return volume_.map(); }

 private:
  const LogInfo& log_info_;
  std::vector<std::string> config_warnings_;
  MemoryBus bus_;
  StageBus stage_bus_{bus_, StageBus::Measure::kNothing};
  ScanRenderer scan_renderer_;
  PhaseRecord phases_{stage_bus_};
  MapRecord map_{stage_bus_};
  ScanRecord scans_;
  EventRecord events_{stage_bus_};
  StateRecord state_{stage_bus_};
  VolumeMapNode volume_;
  std::optional<MappingNode> mapping_;
};

}  // namespace adit

// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "common/bus/memory_bus.hpp"
#include "common/bus/stage_bus.hpp"
#include "procs/mapping/mapping_node.hpp"
#include "procs/volume_map/volume_map_node.hpp"
#include "tools/report/event_record.hpp"
#include "tools/report/log_census.hpp"
#include "tools/report/map_record.hpp"
#include "tools/report/mission_facts.hpp"
#include "tools/report/phase_record.hpp"
#include "tools/report/report.hpp"
#include "tools/report/scan_record.hpp"
#include "tools/report/state_record.hpp"

namespace adit {

/// Plays the logs of a mission to all that keeps something of it, and to the stages that make of it
/// what is wanted: volume_map, and mapping where the map is to be made anew.
class MissionEar {
 public:
  explicit MissionEar(const LogCensus& census, bool remap);
  MissionEar(const MissionEar&) = delete;
  MissionEar& operator=(const MissionEar&) = delete;

  void listen(const ReportOptions& options, const std::function<void(double)>& progress);

  /// Messages that are not what they should be, those of another version among them: a sentence for
  /// each channel.
  [[nodiscard]] std::vector<std::string> complaints() const;
  [[nodiscard]] MissionRecords records() const {
    return {census_, phases_, map_, scans_, events_, state_};
  }
  [[nodiscard]] MapRecord& map() { return map_; }
  [[nodiscard]] const VolumeMap& volume() const { return volume_.map(); }

 private:
  const LogCensus& census_;
  MemoryBus bus_;
  StageBus heard_{bus_, StageBus::Measure::kNothing};
  ScanDrawing drawing_;
  PhaseRecord phases_{heard_};
  MapRecord map_{heard_};
  ScanRecord scans_;
  EventRecord events_{heard_};
  StateRecord state_{heard_};
  VolumeMapNode volume_;
  std::optional<MappingNode> mapping_;
};

}  // namespace adit

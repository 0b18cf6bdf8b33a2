// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <functional>
#include <optional>

#include "common/bus/memory_bus.hpp"
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

  [[nodiscard]] MissionRecords records() const {
    return {census_, phases_, map_, scans_, events_, state_};
  }
  [[nodiscard]] MapRecord& map() { return map_; }
  [[nodiscard]] const VolumeMap& volume() const { return volume_.map(); }

 private:
  const LogCensus& census_;
  MemoryBus bus_;
  ScanDrawing drawing_;
  PhaseRecord phases_{bus_};
  MapRecord map_{bus_};
  ScanRecord scans_;
  EventRecord events_{bus_};
  StateRecord state_{bus_};
  VolumeMapNode volume_;
  std::optional<MappingNode> mapping_;
};

}  // namespace adit

// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <string_view>

#include "common/bus/bus.hpp"
#include "common/bus/sensor_clocks.hpp"
#include "common/messages/diagnostics.hpp"
#include "common/messages/lidar.hpp"
#include "common/types/cloud.hpp"
#include "procs/scan_assembly/cloud_journal.hpp"
#include "procs/scan_assembly/scan_assembly.hpp"

namespace adit {

struct ScanAssemblyNodeParams : ScanAssemblyParams {
  std::string journal;  ///< file for unacknowledged scans; empty: none

  template <class V>
  void visit(V& v) {
    v("journal", journal);
    ScanAssemblyParams::visit(v);
  }
};

/// In:  SCAN_REQUEST (scan_request_t); LASER_FRONT, LASER_REAR (planar_lidar_t); TILT_FRONT,
///      TILT_REAR (tilt_t), or LIDAR (spinning_lidar_t); POSE (pose_t); optional IMU (imu_t).
///      CLOUD_REQUEST (cloud_request_t) of a receiver that may be missing 3D scans.
/// Out: for each request TILT_COMMAND_FRONT or TILT_COMMAND_REAR (tilt_command_t), which sweep the
///      laser and return it to level (not with a spinning lidar); then CLOUD (cloud_t) in
///      fragments. CLOUD_RESEND (cloud_t), in fragments, of one of the newest scans that a receiver
///      is missing.
/// With a journal, a 3D scan is on disk before it is published, and stays there until it is
/// acknowledged: after a restart it can still be requested.
class ScanAssemblyNode {
 public:
  using Params = ScanAssemblyNodeParams;

  /// Throws std::runtime_error if the journal cannot be used.
  ScanAssemblyNode(Bus& bus, const Params& params);

  /// Fault if the journal cannot be written; degraded if the last request was rejected, its sweep
  /// was aborted or not levelled, or the clock of a sensor is off.
  [[nodiscard]] Health health() const;

 private:
  void subscribe_laser(LaserId laser, std::string_view scans, std::string_view tilt);
  void advance(std::int64_t utime);
  void resend_missing(const CloudRequest& request);
  void with_journal(const std::function<void(CloudJournal&)>& work);

  Bus& bus_;
  ScanAssembly scan_assembly_;
  SensorClocks clocks_;
  LidarReassembler revolutions_;
  CloudBuffer buffer_;
  std::optional<CloudJournal> journal_;
  std::string journal_failure_;
};

}  // namespace adit

// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "common/bus/bus.hpp"
#include "common/messages/diagnostics.hpp"
#include "common/types/driving_state.hpp"
#include "common/types/mission.hpp"
#include "common/types/vehicle_state.hpp"

namespace adit {

/// Something that happened on a mission and that a person may want to know.
struct MissionEvent {
  enum class Kind : std::uint8_t { kStop, kOrder, kRestart, kHealth, kDriving };

  Kind kind = Kind::kStop;
  std::int64_t utime = 0;
  std::int64_t to_utime = 0;  ///< the same where it has no length
  std::string source;         ///< name of the stage, or "operator"
  std::string description;    ///< one line

  [[nodiscard]] double seconds() const { return 1e-6 * static_cast<double>(to_utime - utime); }
};

/// Listens to STOP, MISSION_ORDER, HEARTBEAT and DRIVING_STATE for what is out of the ordinary.
class EventRecord {
 public:
  /// More are counted, and not kept.
  static constexpr std::size_t kEventsMax = 5000;

  /// `bus` must outlive this.
  explicit EventRecord(Bus& bus);

  /// To be called when the log has ended, then: what lasted ended with it.
  void finish(std::int64_t end_utime);

  /// In order of time.
  [[nodiscard]] const std::vector<MissionEvent>& events() const { return events_; }
  [[nodiscard]] std::size_t dropped() const { return dropped_; }

 private:
  /// What lasts, by who it is of.
  using OngoingEvents = std::map<std::string, MissionEvent>;

  void on_stop(const StopOrder& order);
  void on_order(const MissionOrder& order);
  void on_heartbeat(const Heartbeat& heartbeat);
  void on_driving(const DrivingState& state);
  void begin_or_extend(OngoingEvents& ongoing, const MissionEvent& event);
  void end(OngoingEvents& ongoing, const std::string& source, std::int64_t utime);
  void add(const MissionEvent& event);

  OngoingEvents stops_;
  OngoingEvents health_;
  OngoingEvents driving_;
  std::map<std::string, Heartbeat> heartbeats_;  ///< the last of each stage
  std::optional<MissionOrder> order_;
  std::vector<MissionEvent> events_;
  std::size_t dropped_ = 0;
};

}  // namespace adit

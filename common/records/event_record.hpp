// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "common/bus/bus.hpp"
#include "common/messages/diagnostics.hpp"
#include "common/sensing/seconds.hpp"
#include "common/types/driving_state.hpp"
#include "common/types/mission.hpp"
#include "common/types/vehicle_state.hpp"

namespace adit {

/// An event of a mission that is worth reporting: a stop, an order, a restart or a fault.
struct MissionEvent {
  enum class Kind : std::uint8_t { kStop, kOrder, kRestart, kHealth, kDriving };

  Kind kind = Kind::kStop;
  std::int64_t utime = 0;
  std::int64_t to_utime = 0;  ///< equal to `utime` for an event without duration
  std::string source;         ///< name of the stage, or "operator"
  std::string description;    ///< one line

  [[nodiscard]] double duration_s() const { return seconds(to_utime - utime); }
};

/// Extracts events from STOP, MISSION_ORDER, HEARTBEAT and DRIVING_STATE.
class EventRecord {
 public:
  /// Events beyond this number are counted only.
  static constexpr std::size_t kEventsMax = 5000;

  /// `bus` must outlive this.
  explicit EventRecord(Bus& bus);

  /// Calls `handler` with each event as it begins; its end is not known then.
  void on_begin(std::function<void(const MissionEvent&)> handler) {
    on_begin_ = std::move(handler);
  }

  /// Must be called at the end of the log. Ends all ongoing events.
  void finish(std::int64_t end_utime);

  /// Sorted by time.
  [[nodiscard]] const std::vector<MissionEvent>& events() const { return events_; }
  [[nodiscard]] std::size_t dropped() const { return dropped_; }

 private:
  /// Events that have not ended yet, by source.
  using OngoingEvents = std::map<std::string, MissionEvent>;

  void on_stop(const StopOrder& order);
  void on_order(const MissionOrder& order);
  void on_heartbeat(const Heartbeat& heartbeat);
  void on_driving(const DrivingState& state);
  void begin_or_extend(OngoingEvents& ongoing, const MissionEvent& event);
  void end_event(OngoingEvents& ongoing, const std::string& source, std::int64_t utime);
  void add_instant(const MissionEvent& event);
  void add(const MissionEvent& event);

  OngoingEvents stops_;
  OngoingEvents health_;
  OngoingEvents driving_;
  std::map<std::string, Heartbeat> heartbeats_;  ///< the last of each stage
  std::optional<MissionOrder> order_;
  std::function<void(const MissionEvent&)> on_begin_;
  std::vector<MissionEvent> events_;
  std::size_t dropped_ = 0;
};

}  // namespace adit

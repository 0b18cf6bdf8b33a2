// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <string>

#include "common/bus/bus.hpp"
#include "common/records/event_record.hpp"
#include "common/types/association.hpp"
#include "common/types/mission.hpp"
#include "viewer/server/topic_board.hpp"

namespace adit {

/// What happened, /events: changes of phase, and the events of EventRecord as they begin, and loop
/// closures that are revoked.
class EventLayer {
 public:
  /// All must outlive this.
  EventLayer(Bus& bus, TopicBoard& board);
  EventLayer(const EventLayer&) = delete;
  EventLayer& operator=(const EventLayer&) = delete;

  void add_phase(const MissionPhase& phase);
  void add_association(const Association& association);

 private:
  enum class Level { kInfo = 2, kWarning = 3, kError = 4 };  ///< those of foxglove.Log

  void add(const MissionEvent& event);
  void append(std::int64_t utime, Level level, const std::string& name, const std::string& text);

  TopicBoard& board_;
  TopicId topic_ = 0;
  EventRecord record_;
  std::int32_t phase_sequence_ = -1;
};

}  // namespace adit

// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "viewer/scene/layers/event_layer.hpp"

#include <fmt/format.h>

#include "viewer/scene/foxglove_values.hpp"
#include "viewer/scene/topic_schema.hpp"

namespace adit {

EventLayer::EventLayer(Bus& bus, TopicBoard& board) : board_(board), record_(bus) {
  topic_ = board.add(protobuf_topic("/events", *foxglove::Log::descriptor()));
  record_.on_begin([this](const MissionEvent& event) { add(event); });
}

void EventLayer::append(std::int64_t utime, Level level, const std::string& name,
                        const std::string& text) {
  foxglove::Log message;
  foxglove_values::set_time(*message.mutable_timestamp(), utime);
  message.set_level(static_cast<foxglove::Log::Level>(level));
  message.set_name(name);
  message.set_message(text);
  board_.append(topic_, utime, message.SerializeAsString());
}

void EventLayer::add(const MissionEvent& event) {
  using Kind = MissionEvent::Kind;
  const bool stop = event.kind == Kind::kStop;
  const bool fault = event.kind == Kind::kHealth && event.description.starts_with("fault");
  const Level level = fault                        ? Level::kError
                      : event.kind == Kind::kOrder ? Level::kInfo
                                                   : Level::kWarning;
  append(event.utime, level, event.source, (stop ? "STOP: " : "") + event.description);
}

void EventLayer::add_phase(const MissionPhase& phase) {
  if (phase.sequence == phase_sequence_) return;
  phase_sequence_ = phase.sequence;
  append(phase.utime, Level::kInfo, "mission",
         fmt::format("{}: {}", name_of(phase.phase), phase.reason));
}

void EventLayer::add_association(const Association& association) {
  if (!association.revokes()) return;
  append(association.utime, Level::kWarning, "mapping",
         fmt::format("loop closure {} of local map {} revoked: {}", association.loop_closure.id,
                     association.loop_closure.newer_map, association.reason));
}

}  // namespace adit

// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "common/records/event_record.hpp"

#include <algorithm>
#include <string_view>

#include "common/bus/channels.hpp"
#include "common/bus/typed_messages.hpp"
#include "common/messages/mission.hpp"
#include "common/messages/navigation.hpp"

namespace adit {
namespace {

using Kind = MissionEvent::Kind;

constexpr std::size_t kQueued = 100;
constexpr std::int64_t kStalenessUs = 5'000'000;  // five heartbeats
constexpr const char* kGuard = "guard";
constexpr const char* kDriving = "driving";

}  // namespace

EventRecord::EventRecord(Bus& bus) {
  const Delivery all = Delivery::queued(kQueued);
  subscribe<stop_t>(bus, channels::kStop, all, [this](const StopOrder& o) { on_stop(o); });
  subscribe<mission_order_t>(bus, channels::kMissionOrder, all,
                             [this](const MissionOrder& o) { on_order(o); });
  subscribe<heartbeat_t>(bus, channels::kHeartbeat, all,
                         [this](const Heartbeat& h) { on_heartbeat(h); });
  subscribe<driving_state_t>(bus, channels::kDrivingState, all,
                             [this](const DrivingState& s) { on_driving(s); });
}

/// Keeps the first reason: the guard repeats the order with updated numbers while the stop lasts.
void EventRecord::on_stop(const StopOrder& order) {
  if (!order.stopped) return end_event(stops_, kGuard, order.utime);
  if (stops_.contains(kGuard)) return;
  begin_or_extend(stops_, {Kind::kStop, order.utime, order.utime, kGuard, order.reason});
}

/// The sender repeats an order until the mission confirms it.
void EventRecord::on_order(const MissionOrder& order) {
  if (!order_ || order_->kind != order.kind) {
    add_instant({Kind::kOrder, order.utime, order.utime, "operator", name_of(order.kind)});
  }
  order_ = order;
}

void EventRecord::on_heartbeat(const Heartbeat& heartbeat) {
  const auto before = heartbeats_.find(heartbeat.stage);
  if (before != heartbeats_.end()) {
    const std::int64_t since_utime = before->second.utime;
    const bool restarted = heartbeat.handled < before->second.handled;
    if (restarted || heartbeat.utime - since_utime > kStalenessUs) {
      add_instant({Kind::kRestart, since_utime, heartbeat.utime, heartbeat.stage,
                   restarted ? "restarted" : "no heartbeat"});
    }
  }
  heartbeats_[heartbeat.stage] = heartbeat;
  if (heartbeat.health.level == Health::Level::kOk) {
    return end_event(health_, heartbeat.stage, heartbeat.utime);
  }
  const bool fault = heartbeat.health.level == Health::Level::kFault;
  begin_or_extend(health_, {Kind::kHealth, heartbeat.utime, heartbeat.utime, heartbeat.stage,
                            (fault ? "fault: " : "degraded: ") + heartbeat.health.reason});
}

void EventRecord::on_driving(const DrivingState& state) {
  const bool waiting = state.kind == DrivingState::Kind::kWaiting;
  const bool failed = state.kind == DrivingState::Kind::kFailed;
  if (!waiting && !failed) return end_event(driving_, kDriving, state.utime);
  begin_or_extend(driving_, {Kind::kDriving, state.utime, state.utime, kDriving,
                             (failed ? "path failed: " : "waiting: ") + state.reason});
}

/// Starts an event, or extends the one of the same source if the descriptions differ in numbers
/// only.
void EventRecord::begin_or_extend(OngoingEvents& ongoing, const MissionEvent& event) {
  const auto without_digits = [](std::string text) {
    std::erase_if(text, [](char c) {
      return std::string_view("0123456789.").find(c) != std::string_view::npos;
    });
    return text;
  };
  const auto current = ongoing.find(event.source);
  if (current != ongoing.end() &&
      without_digits(current->second.description) == without_digits(event.description)) {
    current->second.to_utime = std::max(current->second.to_utime, event.utime);
    return;
  }
  end_event(ongoing, event.source, event.utime);
  ongoing[event.source] = event;
  if (on_begin_) on_begin_(event);
}

void EventRecord::end_event(OngoingEvents& ongoing, const std::string& source, std::int64_t utime) {
  const auto ended = ongoing.find(source);
  if (ended == ongoing.end()) return;
  ended->second.to_utime = std::max(ended->second.utime, utime);
  add(ended->second);
  ongoing.erase(ended);
}

/// An event that does not last.
void EventRecord::add_instant(const MissionEvent& event) {
  if (on_begin_) on_begin_(event);
  add(event);
}

void EventRecord::add(const MissionEvent& event) {
  if (events_.size() < kEventsMax) {
    events_.push_back(event);
  } else {
    ++dropped_;
  }
}

void EventRecord::finish(std::int64_t end_utime) {
  for (OngoingEvents* ongoing : {&stops_, &health_, &driving_}) {
    while (!ongoing->empty()) end_event(*ongoing, std::string(ongoing->begin()->first), end_utime);
  }
  std::stable_sort(events_.begin(), events_.end(),
                   [](const MissionEvent& a, const MissionEvent& b) { return a.utime < b.utime; });
}

}  // namespace adit

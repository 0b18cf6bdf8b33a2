// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "viewer/scene/layers/mission_layer.hpp"

#include <algorithm>
#include <cmath>

#include <nlohmann/json.hpp>

#include "common/bus/channels.hpp"
#include "common/bus/typed_messages.hpp"
#include "common/messages/exploration.hpp"
#include "common/messages/mapping/odometry.hpp"
#include "common/messages/mission.hpp"
#include "common/messages/navigation.hpp"
#include "common/messages/sensing.hpp"
#include "common/pose_graph/map_correction.hpp"
#include "common/sensing/seconds.hpp"
#include "viewer/scene/json_text.hpp"
#include "viewer/scene/topic_schema.hpp"

namespace adit {
namespace {

using nlohmann::json;

constexpr std::int64_t kMissionPeriodUs = 200'000;

json frontier_counts(const ExplorationReport& exploration) {
  json counts = json::object();
  for (const Frontier& frontier : exploration.frontiers) {
    json& count = counts[name_of(frontier.state)];
    count = count.is_null() ? 1 : count.get<int>() + 1;
  }
  return counts;
}

}  // namespace

MissionLayer::MissionLayer(Bus& bus, TopicBoard& board, const MapFrame& frame)
    : board_(board), frame_(frame) {
  topic_ = board.add(json_topic("/mission", "adit.Mission", kMissionPeriodUs),
                     [this] { return mission_message(); });
  const auto keep = [this]<class T>(std::optional<T>& place) {
    return [this, &place](const T& received) {
      place = received;
      set_changed(received.utime);
    };
  };
  const Delivery latest = Delivery::latest();
  subscribe<phase_t>(bus, channels::kPhase, latest, keep(phase_));
  subscribe<exploration_t>(bus, channels::kExploration, latest, keep(exploration_));
  subscribe<driving_state_t>(bus, channels::kDrivingState, latest, keep(driving_));
  subscribe<stop_t>(bus, channels::kStop, latest, keep(stop_));
  subscribe<vehicle_state_t>(bus, channels::kVehicleState, latest, keep(vehicle_));
  subscribe<gas_t>(bus, channels::kGas, latest, keep(gas_));
  subscribe<scan_match_t>(bus, channels::kScanMatch, latest, [this](const ScanMatch& match) {
    match_quality_ = match.status == ScanMatch::Status::kMatched ? match.inlier_share : 0.0;
    set_changed(match.utime);
  });
}

/// A phase keeps the time of its beginning, so that the newest message gives the time.
void MissionLayer::set_changed(std::int64_t utime) {
  utime_ = std::max(utime_, utime);
  board_.set_changed(topic_, utime_);
}

std::string MissionLayer::mission_message() const {
  json mission{{"time_s", seconds(utime_)}, {"phase", "waiting"}, {"outcome", "in progress"}};
  if (phase_) {
    mission.update(json{{"phase", name_of(phase_->phase)},
                        {"reason", phase_->reason},
                        {"returning_home", phase_->returning_home},
                        {"return_home_reason", phase_->return_home_reason},
                        {"goal_id", phase_->goal_id},
                        {"frontier", json_or_null(phase_->frontier)},
                        {"scans", phase_->scans},
                        {"distance_travelled_m", phase_->distance_travelled_m},
                        {"remaining_m", phase_->remaining_m},
                        {"outcome", name_of(phase_->outcome)},
                        {"complete", phase_->complete},
                        {"home_within_m", json_or_null(phase_->home_within_m)}});
  }
  if (exploration_) {
    mission["explored_m"] = exploration_->budget.explored_m;
    mission["frontiers"] = frontier_counts(*exploration_);
    mission["decision_reason"] = exploration_->decision.reason;
  }
  if (driving_) {
    mission["driving"] = name_of(driving_->kind);
    mission["driving_reason"] = driving_->reason;
    mission["path_remaining_m"] = driving_->remaining_m;
  }
  if (stop_) {
    mission["stopped"] = stop_->stopped;
    mission["stop_reason"] = stop_->reason;
  }
  if (vehicle_) {
    mission["speed_m_s"] = vehicle_->speed_m_s;
    mission["battery_share"] = vehicle_->battery_share;
  }
  const auto share = [&](double GasReading::*gas) { return gas_ ? json((*gas_).*gas) : json(); };
  mission["methane_share"] = share(&GasReading::methane_share);
  mission["oxygen_share"] = share(&GasReading::oxygen_share);
  mission["carbon_monoxide_share"] = share(&GasReading::carbon_monoxide_share);
  const auto& correction = frame_.correction();
  mission["position_sd_m"] = correction ? json(position_sd_m(correction->body_covariance)) : json();
  mission["height_sd_m"] = correction ? json(std::sqrt(correction->z_variance)) : json();
  mission["match_quality"] = json_or_null(match_quality_);
  return json_text(mission);
}

}  // namespace adit

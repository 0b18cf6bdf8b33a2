// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "viewer/scene/layers/frontier_layer.hpp"

#include <cmath>
#include <cstdint>

#include <Eigen/Core>
#include <fmt/format.h>

#include "common/bus/channels.hpp"
#include "common/bus/typed_messages.hpp"
#include "common/messages/exploration.hpp"
#include "common/sensing/seconds.hpp"
#include "viewer/scene/foxglove_values.hpp"
#include "viewer/scene/topic_schema.hpp"

namespace adit {
namespace {

namespace values = foxglove_values;

constexpr std::int64_t kFrontiersPeriodUs = 500'000;

values::Rgba color_of(FrontierState state) {
  if (is_visitable(state)) return {.r = 0.0, .g = 0.45, .b = 0.9};
  if (is_abandoned(state)) return {.r = 0.85, .g = 0.55, .b = 0.0};
  if (state == FrontierState::kExplored) return {.r = 0.3, .g = 0.6, .b = 0.3};
  return {.r = 0.75, .g = 0.15, .b = 0.15};
}

void add_frontier(const Frontier& frontier, double z_m, std::int64_t utime,
                  foxglove::SceneUpdate& update) {
  foxglove::SceneEntity& entity =
      values::add_entity(update, utime, fmt::format("frontier {}", frontier.id));
  values::add_metadata(entity, "kind", "frontier");
  values::add_metadata(entity, "id", fmt::to_string(frontier.id));
  values::add_metadata(entity, "state", name_of(frontier.state));
  values::add_metadata(entity, "evidence", frontier.evidence);
  values::add_metadata(entity, "width_m", fmt::format("{:.2f}", frontier.width_m));
  values::add_metadata(entity, "time_s", fmt::format("{:.3f}", seconds(frontier.utime)));
  const double heading_rad = std::atan2(frontier.direction_map.y(), frontier.direction_map.x());
  foxglove::ArrowPrimitive& arrow = *entity.add_arrows();
  values::set_pose(*arrow.mutable_pose(),
                   LevelPose{{frontier.p_map.x(), frontier.p_map.y(), heading_rad}, z_m});
  arrow.set_shaft_length(0.7);
  arrow.set_shaft_diameter(0.12);
  arrow.set_head_length(0.4);
  arrow.set_head_diameter(0.35);
  values::set_color(*arrow.mutable_color(), color_of(frontier.state));
  values::add_text(entity, {frontier.p_map.x(), frontier.p_map.y(), z_m + 0.5},
                   fmt::to_string(frontier.id));
}

}  // namespace

FrontierLayer::FrontierLayer(Bus& bus, TopicBoard& board, const MapFrame& frame) : frame_(frame) {
  const TopicId topic = board.add(
      protobuf_topic("/frontiers", *foxglove::SceneUpdate::descriptor(), kFrontiersPeriodUs),
      [this] { return frontiers_message(); });
  subscribe<exploration_t>(bus, channels::kExploration, Delivery::latest(),
                           [this, &board, topic](const ExplorationReport& report) {
                             exploration_ = report;
                             board.set_changed(topic, report.utime);
                           });
}

std::string FrontierLayer::frontiers_message() const {
  foxglove::SceneUpdate update = values::replacing_update(exploration_->utime);
  for (const Frontier& frontier : exploration_->frontiers) {
    const auto T_map_local = frame_.T_map_local(frontier.local_map);
    add_frontier(frontier, T_map_local ? T_map_local->z_m : 0.0, exploration_->utime, update);
  }
  return update.SerializeAsString();
}

}  // namespace adit

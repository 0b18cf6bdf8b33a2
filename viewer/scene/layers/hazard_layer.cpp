// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "viewer/scene/layers/hazard_layer.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "common/bus/channels.hpp"
#include "common/bus/typed_messages.hpp"
#include "common/messages/sensing.hpp"
#include "common/records/terrain_hazards.hpp"
#include "common/sensing/seconds.hpp"
#include "viewer/scene/foxglove_values.hpp"
#include "viewer/scene/topic_schema.hpp"

namespace adit {
namespace {

namespace values = foxglove_values;

constexpr std::int64_t kHazardsPeriodUs = 1'000'000;
constexpr double kBoxHeightM = 0.3;

}  // namespace

HazardLayer::HazardLayer(Bus& bus, TopicBoard& board, const MapFrame& frame,
                         const RobotLayer& robot, const Vehicle& vehicle)
    : board_(board), frame_(frame), robot_(robot), vehicle_(vehicle) {
  topic_ =
      board.add(protobuf_topic("/hazards", *foxglove::SceneUpdate::descriptor(), kHazardsPeriodUs),
                [this] { return hazards_message(); });
  subscribe<gas_t>(bus, channels::kGas, Delivery::latest(),
                   [this](const GasReading& reading) { on_gas(reading); });
  subscribe<sinkage_t>(bus, channels::kSinkage, Delivery::latest(),
                       [this](const SinkageReading& reading) { on_sinkage(reading); });
}

void HazardLayer::set_changed(std::int64_t utime) {
  utime_ = std::max(utime_, utime);
  board_.set_changed(topic_, utime_);
}

void HazardLayer::on_gas(const GasReading& reading) {
  if (robot_.pose()) add(hazards_of(reading, T_odom_body()));
}

void HazardLayer::on_sinkage(const SinkageReading& reading) {
  if (robot_.pose()) add(hazards_of(reading, T_odom_body()));
}

void HazardLayer::add_path(const PlannedPath& path) {
  add(hazards_of(path, T_odom_body().z_m, vehicle_));
}

void HazardLayer::add_terrain(const TerrainMap& terrain, int number) {
  add(hazards_of(terrain, number, T_odom_body().z_m, vehicle_));
}

LevelPose HazardLayer::T_odom_body() const {
  return robot_.pose() ? LevelPose{robot_.pose()->T_odom_body, robot_.pose()->z_m} : LevelPose{};
}

void HazardLayer::add(const std::vector<Hazard>& observed) {
  for (const Hazard& hazard : observed) add(hazard);
}

/// Joins it with a hazard of its kind that it touches.
void HazardLayer::add(const Hazard& observed) {
  const AnchoredPose T_centre = frame_.anchored(observed.T_odom_centre);
  const LevelPose T_map_centre = frame_.T_map(T_centre);
  for (AnchoredHazard& known : hazards_) {
    const auto shift =
        join(known.hazard, observed, between(frame_.T_map(known.T_centre), T_map_centre));
    if (!shift) continue;
    known.T_centre.T_anchor = known.T_centre.T_anchor * *shift;
    return set_changed(observed.utime);
  }
  if (hazards_.size() >= kHazardsMax) return;
  hazards_.push_back({observed, T_centre});
  set_changed(observed.utime);
}

std::string HazardLayer::hazards_message() const {
  foxglove::SceneUpdate update = values::replacing_update(utime_);
  int number = 0;
  for (const auto& [hazard, T_centre] : hazards_) {
    const LevelPose T_map_hazard = frame_.T_map(T_centre);
    foxglove::SceneEntity& entity =
        values::add_entity(update, utime_, fmt::format("{} {}", hazard.kind, ++number));
    const std::string value =
        std::isfinite(hazard.value) ? fmt::format("{:.2f}", hazard.value) : "";
    values::add_metadata(entity, "kind", hazard.kind);
    values::add_metadata(entity, "value", value);
    values::add_metadata(entity, "unit", hazard.unit);
    values::add_metadata(entity, "evidence", hazard.evidence);
    values::add_metadata(entity, "time_s", fmt::format("{:.3f}", seconds(hazard.utime)));
    foxglove::CubePrimitive& cube = *entity.add_cubes();
    values::set_pose(*cube.mutable_pose(), T_map_hazard);
    cube.mutable_size()->set_x(hazard.size_m.x());
    cube.mutable_size()->set_y(hazard.size_m.y());
    cube.mutable_size()->set_z(kBoxHeightM);
    const bool water = hazard.kind == "water";
    values::set_color(*cube.mutable_color(),
                      water ? values::Rgba{.r = 0.1, .g = 0.4, .b = 0.9, .a = 0.5}
                            : values::Rgba{.r = 0.9, .g = 0.3, .b = 0.1, .a = 0.5});
    values::add_text(
        entity, T_map_hazard.translation(),
        value.empty() ? hazard.kind : fmt::format("{} {} {}", hazard.kind, value, hazard.unit));
  }
  return update.SerializeAsString();
}

}  // namespace adit

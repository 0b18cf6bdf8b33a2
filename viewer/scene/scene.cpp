// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "viewer/scene/scene.hpp"

#include <cstddef>
#include <utility>

#include "common/bus/channels.hpp"
#include "common/bus/typed_messages.hpp"
#include "common/messages/mapping/pose_graph.hpp"
#include "common/messages/sim.hpp"

namespace adit {
namespace {

constexpr std::size_t kPosesQueued = 200;
constexpr std::size_t kFragmentsQueued = 1000;

}  // namespace

Scene::Scene(Bus& bus, TopicBoard& board, const SceneParameters& parameters)
    : bus_(bus),
      parameters_(parameters),
      robot_(bus, board, frame_, parameters_.lasers),
      map_(board, frame_, path_, parameters_),
      mission_(bus, board, frame_) {
  subscribe_map();
  subscribe_objects();
  subscribe<sim_time_t>(bus, channels::kSimTime, Delivery::latest(),
                        [this](const SimTime& time) { simulated_utime_ = time.utime; });
}

void Scene::subscribe_map() {
  map_subscription_.subscribe(
      bus_, {.on_local_map =
                 [this](const LocalMap& map) {
                   frame_.add_local_map(map);
                   map_.add_local_map(map, robot_.lasers());
                 },
             .on_graph = [this](MapGraph graph) { frame_.set_graph(std::move(graph)); },
             .on_association = [](const Association&) {},
             .on_contradictions = [](const MapContradictions&) {}});
  frame_.on_graph([this](std::int64_t utime) { map_.set_changed(utime); });
  subscribe<map_correction_t>(
      bus_, channels::kMapCorrection, Delivery::latest(),
      [this](const MapCorrection& correction) { frame_.set_correction(correction); });
}

void Scene::subscribe_objects() {
  subscribe<pose_t>(bus_, channels::kPose, Delivery::queued(kPosesQueued),
                    [this](const StampedPose& pose) { path_.add(pose); });
  subscribe<terrain_t>(bus_, channels::kTerrain, Delivery::queued(kFragmentsQueued),
                       [this](const TerrainFragment& fragment) {
                         if (const auto terrain = terrain_fragments_.add(fragment))
                           map_.add_terrain(*terrain);
                       });
}

std::int64_t Scene::now_utime() const {
  return simulated_utime_ != 0 ? simulated_utime_ : bus_.now_utime();
}

}  // namespace adit

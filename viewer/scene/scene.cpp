// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "viewer/scene/scene.hpp"

#include <cstddef>
#include <utility>

#include "common/bus/channels.hpp"
#include "common/bus/typed_messages.hpp"
#include "common/messages/mapping/pose_graph.hpp"
#include "common/messages/mission.hpp"
#include "common/messages/navigation.hpp"
#include "common/messages/sensing.hpp"
#include "common/messages/sim.hpp"

namespace adit {
namespace {

constexpr std::size_t kPosesQueued = 200;
constexpr std::size_t kFragmentsQueued = 1000;
constexpr std::size_t kPathsQueued = 50;
constexpr std::size_t kPhasesQueued = 100;

}  // namespace

Scene::Scene(Bus& bus, TopicBoard& board, const SceneParameters& parameters)
    : bus_(bus),
      parameters_(parameters),
      robot_(bus, board, frame_, parameters_.lasers),
      map_(board, frame_, path_, parameters_),
      clouds_(board, frame_, parameters_),
      paths_(board, frame_, path_),
      graph_(board, frame_),
      frontiers_(bus, board, frame_),
      hazards_(bus, board, frame_, robot_, parameters_.vehicle),
      uncertainty_(board, frame_, path_, robot_),
      mission_(bus, board, frame_),
      processes_(bus, board, [this] { return now_utime(); }),
      events_(bus, board),
      scans_(bus, board, frame_),
      history_(board, frame_, mission_) {
  subscribe_map();
  subscribe_path();
  subscribe_scans();
  subscribe<phase_t>(bus, channels::kPhase, Delivery::queued(kPhasesQueued),
                     [this](const MissionPhase& phase) {
                       path_.set_homeward(phase.returning_home);
                       events_.add_phase(phase);
                     });
  subscribe<sim_time_t>(bus, channels::kSimTime, Delivery::latest(),
                        [this](const SimTime& time) { simulated_utime_ = time.utime; });
}

void Scene::subscribe_map() {
  map_subscription_.subscribe(bus_, {.on_local_map =
                                         [this](const LocalMap& map) {
                                           frame_.add_local_map(map);
                                           map_.add_local_map(map, robot_.lasers());
                                         },
                                     .on_graph =
                                         [this](MapGraph graph) {
                                           const std::int64_t utime = graph.utime;
                                           frame_.set_graph(std::move(graph));
                                           on_graph(utime);
                                         },
                                     .on_association =
                                         [this](const Association& association) {
                                           graph_.add_association(association);
                                           events_.add_association(association);
                                         },
                                     .on_contradictions = [](const MapContradictions&) {}});
  subscribe<map_correction_t>(bus_, channels::kMapCorrection, Delivery::latest(),
                              [this](const MapCorrection& correction) {
                                frame_.set_correction(correction);
                                uncertainty_.add_correction(correction);
                              });
}

/// All that is anchored to local maps has moved.
void Scene::on_graph(std::int64_t utime) {
  map_.set_changed(utime);
  clouds_.set_changed(utime);
  paths_.set_changed(utime);
  graph_.set_changed(utime);
  hazards_.set_changed(utime);
  history_.update_poses();
}

void Scene::on_match(const ScanMatch& match) {
  const auto laser = laser_from_channel(match.channel);
  if (!laser || robot_.scan(*laser).utime != match.utime) return;
  const Lasers& lasers = robot_.lasers();
  map_.add_scan(match, robot_.scan(*laser), *laser == LaserId::kFront ? lasers.front : lasers.rear);
}

void Scene::subscribe_path() {
  subscribe<scan_match_t>(bus_, channels::kScanMatch, Delivery::latest(),
                          [this](const ScanMatch& match) { on_match(match); });
  subscribe<pose_t>(bus_, channels::kPose, Delivery::queued(kPosesQueued),
                    [this](const StampedPose& pose) {
                      if (path_.add(pose)) paths_.set_changed(pose.utime);
                      history_.add_pose(pose);
                    });
  subscribe<planned_path_t>(bus_, channels::kPath, Delivery::queued(kPathsQueued),
                            [this](const PlannedPath& path) {
                              paths_.set_planned(path);
                              hazards_.add_path(path);
                            });
}

void Scene::subscribe_scans() {
  subscribe<cloud_t>(bus_, channels::kCloud, Delivery::queued(kFragmentsQueued),
                     [this](const CloudFragment& fragment) {
                       const auto cloud = cloud_fragments_.add(fragment);
                       if (!cloud) return;
                       scan_ = scans_.add_cloud(*cloud);
                       clouds_.add_cloud(*cloud, scan_);
                     });
  subscribe<terrain_t>(bus_, channels::kTerrain, Delivery::queued(kFragmentsQueued),
                       [this](const TerrainFragment& fragment) {
                         const auto terrain = terrain_fragments_.add(fragment);
                         if (!terrain) return;
                         map_.add_terrain(*terrain);
                         clouds_.add_terrain(*terrain);
                         hazards_.add_terrain(*terrain, scan_);
                       });
}

std::int64_t Scene::now_utime() const {
  return simulated_utime_ != 0 ? simulated_utime_ : bus_.now_utime();
}

}  // namespace adit

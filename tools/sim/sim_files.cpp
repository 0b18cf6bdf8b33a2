// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "tools/sim/sim_files.hpp"

#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "common/bus/channels.hpp"
#include "common/bus/log/lcm_log.hpp"
#include "common/files/file_utils.hpp"
#include "common/geometry/local_crs.hpp"
#include "common/messages/codec.hpp"
#include "common/messages/mapping/cloud.hpp"
#include "tools/cloud/cloud_file.hpp"

namespace adit {
namespace {

using Json = nlohmann::ordered_json;

Json position(const Eigen::Vector2d& p) { return {p.x(), p.y()}; }

Json positions(const std::vector<Eigen::Vector2d>& points) {
  Json list = Json::array();
  for (const Eigen::Vector2d& p : points) list.push_back(position(p));
  return list;
}

Json feature(const std::string& type, Json coordinates, Json properties) {
  return {{"type", "Feature"},
          {"properties", std::move(properties)},
          {"geometry", {{"type", type}, {"coordinates", std::move(coordinates)}}}};
}

Json collection(Json features) {
  return {{"type", "FeatureCollection"},
          {"crs",
           {{"type", "name"},
            {"properties", {{"name", local_crs_wkt("frame world of the mine", "its origin")}}}}},
          {"units", "metres, frame world"},
          {"features", std::move(features)}};
}

const char* name_of(PartKind kind) {
  switch (kind) {
    case PartKind::kFloor:
      return "floor";
    case PartKind::kRoof:
      return "roof";
    case PartKind::kWall:
      return "wall";
    case PartKind::kRail:
      return "rail";
    case PartKind::kSleeper:
      return "sleeper";
    case PartKind::kPost:
      return "post";
    case PartKind::kCrib:
      return "crib";
    case PartKind::kRubble:
      return "rubble";
    case PartKind::kBeam:
      return "beam";
    case PartKind::kCable:
      return "cable";
    case PartKind::kCar:
      return "car";
    case PartKind::kWater:
      return "water";
    case PartKind::kOther:
      return "other";
  }
  return "other";
}

/// The height of the floor at each node, where it is known.
Json tunnels(const WorldTruth& truth) {
  const TunnelGraph& graph = truth.tunnels;
  Json features = Json::array();
  for (std::size_t i = 0; i < graph.nodes.size(); ++i) {
    const TunnelNode& node = graph.nodes[i];
    Json properties = {{"node", i}, {"entrance", node.entrance}, {"level", node.level}};
    if (const auto floor_m = truth.floor_at(node.p_world, node.level)) {
      properties["floor_m"] = *floor_m;
    }
    features.push_back(feature("Point", position(node.p_world), std::move(properties)));
  }
  for (const TunnelEdge& edge : graph.edges) {
    features.push_back(feature("LineString", positions(edge.points),
                               {{"from", edge.from},
                                {"to", edge.to},
                                {"tunnel", edge.tunnel},
                                {"level", edge.level},
                                {"length_m", edge.length_m},
                                {"width_m", edge.width_m}}));
  }
  return collection(std::move(features));
}

/// GeoJSON closes a ring by repeating its first point.
Json plan(const std::vector<PlanRing>& rings) {
  Json features = Json::array();
  for (const PlanRing& ring : rings) {
    std::vector<Eigen::Vector2d> closed = ring.points;
    if (!closed.empty()) closed.push_back(closed.front());
    features.push_back(feature("LineString", positions(closed),
                               {{"pillar", ring.is_pillar()}, {"level", ring.level}}));
  }
  return collection(std::move(features));
}

Json obstacles(const std::vector<Obstacle>& all) {
  Json list = Json::array();
  for (const Obstacle& obstacle : all) {
    list.push_back({{"kind", name_of(obstacle.kind)},
                    {"name", obstacle.name},
                    {"level", obstacle.level},
                    {"outline_m", positions(obstacle.outline)},
                    {"z_low_m", obstacle.z_low_m},
                    {"z_high_m", obstacle.z_high_m}});
  }
  return list;
}

void write(const Json& json, const std::filesystem::path& path) {
  write_text_file(json.dump() + "\n", path);
}

void write_log(const Cloud& cloud, const std::filesystem::path& file) {
  LogWriter log(file, LogWriter::Name::kWhenClosed);
  for (const CloudFragment& fragment : split(cloud)) {
    log.write({cloud.utime, channels::kCloud, encode(to_message(fragment))});
  }
  log.close();
}

}  // namespace

void write_truth_files(const World& world, const std::filesystem::path& folder) {
  std::filesystem::create_directories(folder);
  write(tunnels(world.truth), folder / "tunnels.geojson");
  write(plan(world.truth.plan), folder / "plan.geojson");
  write(obstacles(world.truth.obstacles), folder / "obstacles.json");
}

std::vector<std::string> missing_truth(const World& world) {
  std::vector<std::string> sentences;
  if (world.truth.tunnels.edges.empty()) {
    sentences.emplace_back(
        "tunnels.geojson is empty: a mesh, or a plan of rooms alone, has no centre lines");
  }
  if (world.truth.plan.empty()) {
    sentences.emplace_back(
        "plan.geojson is empty: the mesh has no closed outline around the start at the height of "
        "the lasers");
  }
  return sentences;
}

void write_scan(const Cloud& cloud, const std::filesystem::path& file) {
  if (file.extension() == ".lcmlog") return write_log(cloud, file);
  if (file.extension() == ".ply") return write_ply(cloud, file);
  throw std::runtime_error(
      fmt::format("{}: the file of a 3D scan must end in .lcmlog or .ply", file.string()));
}

}  // namespace adit

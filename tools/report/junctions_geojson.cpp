// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "tools/report/junctions_geojson.hpp"

#include <cmath>

#include <nlohmann/json.hpp>

#include "tools/report/map_layers.hpp"

namespace adit {
namespace {

using Json = nlohmann::ordered_json;

/// To the millimetre.
Json coordinates(const Eigen::Vector2d& p_map) {
  return {std::round(1e3 * p_map.x()) / 1e3, std::round(1e3 * p_map.y()) / 1e3};
}

Json feature(const char* type, Json coordinates, Json properties) {
  return {{"type", "Feature"},
          {"geometry", {{"type", type}, {"coordinates", std::move(coordinates)}}},
          {"properties", std::move(properties)}};
}

const char* kind_of(CorridorNode::Kind kind) {
  switch (kind) {
    case CorridorNode::Kind::kJunction:
      return "junction";
    case CorridorNode::Kind::kDeadEnd:
      return "dead_end";
    case CorridorNode::Kind::kOpenEnd:
      return "open_end";
  }
  return "";
}

Json corridor_feature(const Corridor& corridor) {
  Json line = Json::array();
  for (const Eigen::Vector2d& p_map : corridor.points) line.push_back(coordinates(p_map));
  return feature("LineString", std::move(line),
                 {{"kind", "corridor"},
                  {"from", corridor.from},
                  {"to", corridor.to},
                  {"length_m", corridor.length_m},
                  {"width_m", corridor.width_m}});
}

Json stub_feature(const Stub& stub) {
  return feature("Point", coordinates(stub.p_map),
                 {{"kind", "opening"},
                  {"id", stub.id},
                  {"state", name_of(stub.state)},
                  {"closed", is_closed(stub.state)},
                  {"evidence", stub.evidence},
                  {"since_utime", stub.utime},
                  {"direction", coordinates(stub.direction_map)},
                  {"width_m", stub.width_m},
                  {"local_map", stub.local_map}});
}

}  // namespace

std::string junctions_geojson(const ExplorationReport& report) {
  Json features = Json::array();
  for (std::size_t i = 0; i < report.corridors.nodes.size(); ++i) {
    const CorridorNode& node = report.corridors.nodes[i];
    features.push_back(
        feature("Point", coordinates(node.p_map), {{"kind", kind_of(node.kind)}, {"node", i}}));
  }
  for (const Corridor& corridor : report.corridors.corridors) {
    features.push_back(corridor_feature(corridor));
  }
  for (const Stub& stub : report.stubs) features.push_back(stub_feature(stub));
  const Json json{{"type", "FeatureCollection"},
                  {"coordinates_are",
                   "metres in the plan of the map frame (x, y; origin where the first local map "
                   "began), not longitude and latitude"},
                  {"graph_revision", report.revision},
                  {"features", std::move(features)}};
  return json.dump(1, ' ', false, Json::error_handler_t::replace) + "\n";
}

}  // namespace adit

// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "tools/report/report_files.hpp"

#include <cmath>
#include <cstddef>
#include <set>
#include <string>
#include <utility>

#include <nlohmann/json.hpp>

#include "common/bus/log/recording.hpp"
#include "common/files/file_utils.hpp"
#include "common/geometry/local_crs.hpp"
#include "common/grid/occupancy_grid.hpp"
#include "common/journal/journal.hpp"
#include "common/picture/map_picture.hpp"
#include "common/pose_graph/g2o_file.hpp"
#include "common/types/exploration.hpp"
#include "procs/volume_map/volume_export.hpp"
#include "tools/eval/trajectory.hpp"
#include "tools/map/map_files.hpp"
#include "tools/report/text_format.hpp"

namespace adit {
namespace {

using Json = nlohmann::ordered_json;

Json phases_json(const MissionStatistics& statistics) {
  Json phases = Json::object();
  for (const PhaseShare& share : statistics.phases) {
    phases[name_of(share.phase)] = {
        {"times", share.times}, {"duration_s", share.duration_s}, {"share", share.share}};
  }
  return {{"reported_by_mission", statistics.last.has_value()}, {"by_phase", std::move(phases)}};
}

Json time_json(const TimeBudget& budget) {
  Json activities = Json::object();
  for (std::size_t i = 0; i < kActivities; ++i) {
    const auto activity = static_cast<Activity>(i);
    const TimeBudget::Share& share = budget.share(activity);
    activities[name_of(activity)] = {
        {"times", share.times}, {"duration_s", share.duration_s}, {"distance_m", share.distance_m}};
  }
  return activities;
}

Json outcome_json(const MissionStatistics& statistics) {
  return {{"outcome", statistics.last ? Json(name_of(statistics.last->outcome)) : Json()},
          {"complete", statistics.last ? Json(statistics.last->complete) : Json()},
          {"text", outcome_text(statistics)},
          {"last_phase", statistics.last ? Json(name_of(statistics.last->phase)) : Json()},
          {"last_reason", statistics.last ? Json(statistics.last->reason) : Json()},
          {"return_home_reason",
           statistics.return_home_reason.empty() ? Json() : Json(statistics.return_home_reason)},
          {"distance_from_start_m", statistics.distance_from_start_m},
          {"home_within_m", statistics.last && statistics.last->home_within_m
                                ? Json(*statistics.last->home_within_m)
                                : Json()}};
}

Json frontiers_json(const MissionStatistics& statistics) {
  if (!statistics.frontiers) return {};
  return {{"found", statistics.frontiers->found},
          {"closed", statistics.frontiers->closed},
          {"open", statistics.frontiers->open},
          {"blocked", statistics.frontiers->blocked},
          {"unconfirmed", statistics.frontiers->unconfirmed},
          {"corridors_explored_m", *statistics.explored_m}};
}

Json truth_json(const MissionStatistics& statistics) {
  if (!statistics.score) return {};
  const TrajectoryScore& score = *statistics.score;
  Json json = {{"poses", score.poses},
               {"rmse_m", score.aligned.rmse_m},
               {"max_m", score.aligned.max_m},
               {"anchored_rmse_m", score.anchored.rmse_m},
               {"anchored_max_m", score.anchored.max_m},
               {"true_length_m", score.true_length_m},
               {"plan_of_allowed", score.plan_of_allowed}};
  if (const auto& consistency = statistics.consistency) {
    json["local_maps"] = consistency->local_maps;
    json["in_95_percent_interval_xyz"] = consistency->in_interval;
    json["in_95_percent_ellipsoid"] = consistency->in_ellipsoid;
    json["normalised_error_squared"] = consistency->normalised_error_squared;
  }
  if (!score.heights) return json;
  json["height_of_allowed"] = score.height_of_allowed;
  json["anchored_rmse_z_m"] = score.anchored.z.rmse_m;
  json["anchored_max_z_m"] = score.anchored.z.max_m;
  return json;
}

Json configs_json(const LogInfo& log_info) {
  Json configs = Json::object();
  for (const auto& [stage, config] : log_info.configs) {
    configs[stage] = {{"version", config.version}, {"yaml", config.yaml}};
  }
  return configs;
}

/// The stretches on which the map contradicts itself.
Json contradictory_json(const MissionStatistics& statistics) {
  Json list = Json::array();
  for (const DoubtfulStretch& stretch : statistics.contradictory) {
    list.push_back({{"from_utime", stretch.from_utime},
                    {"to_utime", stretch.to_utime},
                    {"from_m", stretch.from_m},
                    {"to_m", stretch.to_m},
                    {"local_maps", stretch.local_maps}});
  }
  return list;
}

/// What the stages said of damaged journals, each line once.
Json journals_json(const EventRecord& events) {
  std::set<std::string> lines;
  for (const MissionEvent& event : events.events()) {
    if (event.kind == MissionEvent::Kind::kHealth && is_about_journal(event.description))
      lines.insert(event.description);
  }
  return lines;
}

/// Why the recording stopped before the end of the mission; null if it did not say so.
Json record_stopped_json(const EventRecord& events) {
  for (const MissionEvent& event : events.events()) {
    const bool is_health = event.kind == MissionEvent::Kind::kHealth;
    if (is_health && event.source == Recording::kStage) return event.description;
  }
  return {};
}

/// Figures of a mission as JSON, for summary.json. Values without data in the log are null.
std::string mission_summary_json(const MissionStatistics& statistics, const EventRecord& events,
                                 const LogInfo& log_info) {
  const Json json{
      {"simulated", statistics.simulated},
      {"begin", date_text(statistics.from_utime)},
      {"begin_utime", statistics.from_utime},
      {"end_utime", statistics.to_utime},
      {"duration_s", statistics.duration_s()},
      {"distance_travelled_m", statistics.distance_travelled_m},
      {"max_distance_from_start_m", statistics.farthest_m},
      {"mission", outcome_json(statistics)},
      {"phases", phases_json(statistics)},
      {"time_by_activity", time_json(statistics.budget)},
      {"scans", {{"taken", statistics.scans}, {"without_path", statistics.scans_without_path}}},
      {"map",
       {{"local_maps", statistics.local_maps},
        {"loop_closures",
         {{"proposed", statistics.loop_closures.proposed},
          {"accepted", statistics.loop_closures.accepted},
          {"revised", statistics.loop_closures.revised},
          {"revoked", statistics.revoked}}},
        {"contradictory_stretches", contradictory_json(statistics)}}},
      {"frontiers", frontiers_json(statistics)},
      {"guard", {{"stops", statistics.stops}, {"stopped_s", statistics.stopped_s}}},
      {"restarts", statistics.restarts},
      {"damaged_journals", journals_json(events)},
      {"record_stopped", record_stopped_json(events)},
      {"against_truth", truth_json(statistics)},
      {"collision", statistics.failure ? Json(!statistics.failure->empty()) : Json()},
      {"failure", statistics.failure ? Json(*statistics.failure) : Json()},
      {"warnings", log_info.warnings},
      {"version", statistics.version},
      {"messages", log_info.messages},
      {"config", configs_json(log_info)}};
  return json.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

/// Rounded to millimetres.
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

Json frontier_feature(const Frontier& frontier) {
  return feature("Point", coordinates(frontier.p_map),
                 {{"kind", "frontier"},
                  {"id", frontier.id},
                  {"state", name_of(frontier.state)},
                  {"closed", is_closed(frontier.state)},
                  {"evidence", frontier.evidence},
                  {"since_utime", frontier.utime},
                  {"direction", coordinates(frontier.direction_map)},
                  {"width_m", frontier.width_m},
                  {"local_map", frontier.local_map}});
}

/// The corridor graph as GeoJSON: corridors as lines; junctions, dead ends and frontiers as points,
/// frontiers with state and evidence. Coordinates are x and y in the map frame in metres, not
/// longitude and latitude; `crs` says so to programs, the foreign member `coordinates_are` to
/// people.
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
  for (const Frontier& frontier : report.frontiers) features.push_back(frontier_feature(frontier));
  const Json json{
      {"type", "FeatureCollection"},
      {"crs",
       {{"type", "name"},
        {"properties",
         {{"name",
           local_crs_wkt("map frame of the mission", "first pose of the first local map")}}}}},
      {"coordinates_are",
       "x and y in the map frame in metres (origin: first pose of the first local map), "
       "not longitude and latitude"},
      {"graph_revision", report.revision},
      {"features", std::move(features)}};
  return json.dump(1, ' ', false, Json::error_handler_t::replace) + "\n";
}

/// The junctions and dead ends, the 3D scans, and the frontiers that are not explored.
std::vector<MapPicture::Place> places_of(const MapContent& map) {
  using PlaceKind = MapPicture::Place::Kind;
  std::vector<MapPicture::Place> places;
  for (const ScanMark& scan : map.scans)
    places.push_back({scan.T_map_laser.translation(), PlaceKind::kScan});
  if (map.exploration == nullptr) return places;
  for (const CorridorNode& node : map.exploration->corridors.nodes) {
    if (node.kind == CorridorNode::Kind::kJunction)
      places.push_back({node.p_map, PlaceKind::kJunction});
    if (node.kind == CorridorNode::Kind::kDeadEnd)
      places.push_back({node.p_map, PlaceKind::kDeadEnd});
  }
  for (const Frontier& frontier : map.exploration->frontiers) {
    const bool explored =
        frontier.state == FrontierState::kExplored || frontier.state == FrontierState::kOutsideMine;
    if (explored) continue;
    places.push_back({frontier.p_map, is_closed(frontier.state) ? PlaceKind::kBlockedFrontier
                                                                : PlaceKind::kOpenFrontier});
  }
  return places;
}

void write_map(const ReportInput& input, const std::filesystem::path& folder,
               std::vector<std::string>& warnings) {
  if (input.map.grid == nullptr) {
    warnings.emplace_back(
        "no map: the log has no usable LOCAL_MAP (--remap builds the map from the laser scans)");
    return;
  }
  write_map_server(*input.map.grid, folder, "map");
  MapPicture picture = map_picture(input.map.map->full_map(), input.title);
  picture.places = places_of(input.map);
  if (!input.statistics.contradictory.empty()) {
    const FullMap& map = input.map.map->full_map();
    for (const Spool<TimedPose>& path : map.paths) {
      for (std::size_t i = 0; i < path.size(); i += pose_step(map)) {
        picture.doubtful.push_back(in_stretches(input.statistics.contradictory, path[i].utime));
      }
    }
  }
  write_map_png(*input.map.grid, picture, folder / "map.png");
}

void write_graph(const ReportInput& input, const std::filesystem::path& folder,
                 std::vector<std::string>& warnings) {
  if (input.map.map->full_map().graph.poses.empty()) {
    warnings.emplace_back("no graph.g2o: the log has no POSE_GRAPH");
    return;
  }
  write_g2o(g2o_of(input.map.map->full_map().graph), folder / "graph.g2o");
}

void write_volume(const ReportInput& input, const std::filesystem::path& folder,
                  std::vector<std::string>& warnings) {
  if (input.volume.volumes().empty()) {
    warnings.emplace_back("no cloud.ply and volume.bt: the log has no 3D scan (CLOUD)");
    return;
  }
  input.volume.merged().write_bt(folder / "volume.bt");
  write_ply(input.volume, folder / "cloud.ply");
}

void write_junctions(const ReportInput& input, const std::filesystem::path& folder,
                     std::vector<std::string>& warnings) {
  if (input.map.exploration == nullptr) {
    warnings.emplace_back("no junctions.geojson: the log has no EXPLORATION");
    return;
  }
  write_text_file(junctions_geojson(*input.map.exploration), folder / "junctions.geojson");
}

}  // namespace

std::vector<std::string> write_report_files(const ReportInput& input,
                                            const std::filesystem::path& folder) {
  std::vector<std::string> warnings;
  write_tum(folder / "trajectory.tum", input.map.map->path());
  write_map(input, folder, warnings);
  write_text_file(map_svg_file(input.map, input.title), folder / "map.svg");
  write_graph(input, folder, warnings);
  write_volume(input, folder, warnings);
  write_junctions(input, folder, warnings);
  write_text_file(
      mission_summary_json(input.statistics, input.records.events, input.records.log_info),
      folder / "summary.json");
  return warnings;
}

}  // namespace adit

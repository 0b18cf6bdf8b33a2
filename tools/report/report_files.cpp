// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "tools/report/report_files.hpp"

#include <utility>

#include "common/files/file_utils.hpp"
#include "common/grid/occupancy_grid.hpp"
#include "common/picture/map_picture.hpp"
#include "common/pose_graph/g2o_file.hpp"
#include "procs/volume_map/volume_export.hpp"
#include "tools/eval/tum.hpp"
#include "tools/map/map_files.hpp"
#include "tools/report/report_json.hpp"

namespace adit {
namespace {

MapPicture picture_of(const ReportInput& input) {
  MapPicture picture;
  picture.title = input.title;
  for (const Trajectory& path : input.map.map->full_map().paths) {
    if (!picture.path.empty()) picture.jumps.push_back(picture.path.size());
    for (const TimedPose& pose : path) picture.path.push_back(pose.pose);
  }
  picture.graph = graph_picture(input.map.map->full_map());
  return picture;
}

void write_map(const ReportInput& input, const std::filesystem::path& folder,
               std::vector<std::string>& missing) {
  if (input.map.grid == nullptr) {
    missing.emplace_back(
        "no map: there is no LOCAL_MAP in the log that can be drawn (--remap maps it anew)");
    return;
  }
  write_map_server(*input.map.grid, folder, "map");
  write_map_png(*input.map.grid, picture_of(input), folder / "map.png");
}

void write_graph(const ReportInput& input, const std::filesystem::path& folder,
                 std::vector<std::string>& missing) {
  if (input.map.map->full_map().graph.poses.empty()) {
    missing.emplace_back("no graph.g2o: there is no POSE_GRAPH in the log");
    return;
  }
  write_g2o(g2o_of(input.map.map->full_map().graph), folder / "graph.g2o");
}

void write_volume(const ReportInput& input, const std::filesystem::path& folder,
                  std::vector<std::string>& missing) {
  if (input.volume.volumes().empty()) {
    missing.emplace_back("no cloud.ply and volume.bt: there is no 3D scan in the log (CLOUD)");
    return;
  }
  input.volume.merged().write_bt(folder / "volume.bt");
  write_ply(input.volume, folder / "cloud.ply");
}

void write_junctions(const ReportInput& input, const std::filesystem::path& folder,
                     std::vector<std::string>& missing) {
  if (input.map.exploration == nullptr) {
    missing.emplace_back("no junctions.geojson: there is no EXPLORATION in the log");
    return;
  }
  write_text_file(junctions_geojson(*input.map.exploration), folder / "junctions.geojson");
}

}  // namespace

std::vector<std::string> write_report_files(const ReportInput& input,
                                            const std::filesystem::path& folder) {
  std::vector<std::string> missing;
  write_tum(folder / "trajectory.tum", input.map.map->path());
  write_map(input, folder, missing);
  write_text_file(map_svg_file(input.map, input.title), folder / "map.svg");
  write_graph(input, folder, missing);
  write_volume(input, folder, missing);
  write_junctions(input, folder, missing);
  write_text_file(mission_summary_json(input.statistics, input.records.log_info),
                  folder / "summary.json");
  return missing;
}

}  // namespace adit

// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "tools/report/report_files.hpp"

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

void write_map(const ReportInput& input, const std::filesystem::path& folder,
               std::vector<std::string>& warnings) {
  if (input.map.grid == nullptr) {
    warnings.emplace_back(
        "no map: the log has no usable LOCAL_MAP (--remap builds the map from the laser scans)");
    return;
  }
  write_map_server(*input.map.grid, folder, "map");
  MapPicture picture = map_picture(input.map.map->full_map(), input.title);
  picture.graph = graph_picture(input.map.map->full_map());
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
  write_text_file(mission_summary_json(input.statistics, input.records.log_info),
                  folder / "summary.json");
  return warnings;
}

}  // namespace adit

// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "procs/volume_map/volume_export.hpp"

#include <bit>
#include <fstream>
#include <string>

#include <fmt/format.h>

#include "common/files/file_error.hpp"

namespace adit {
namespace {

static_assert(std::endian::native == std::endian::little, "PLY is written in memory order");

struct Vertex {
  float x = 0.0F;
  float y = 0.0F;
  float z = 0.0F;
  std::int32_t scan = 0;
};
static_assert(sizeof(Vertex) == 16);

std::string header(std::size_t n) {
  return fmt::format(
      "ply\nformat binary_little_endian 1.0\ncomment frame map, metres\nelement vertex {}\n"
      "property float x\nproperty float y\nproperty float z\nproperty int scan\nend_header\n",
      n);
}

Vertex vertex(const VolumePoint& point, const LevelPose& T_map_volume) {
  const Eigen::Vector3f p_map =
      (T_map_volume * Eigen::Vector3d(point.p_volume.cast<double>())).cast<float>();
  return {p_map.x(), p_map.y(), p_map.z(), point.scan};
}

}  // namespace

void write_ply(const VolumeMap& map, const std::filesystem::path& path) {
  std::size_t n = 0;
  for (const PlacedVolume& placed : map.volumes()) {
    if (!placed.excluded) n += placed.volume.points().size();
  }
  std::ofstream file(path, std::ios::binary);
  file << header(n);
  for (const PlacedVolume& placed : map.volumes()) {
    if (placed.excluded) continue;
    for (const VolumePoint& point : placed.volume.points()) {
      const Vertex at = vertex(point, placed.T_map_volume);
      file.write(reinterpret_cast<const char*>(&at), sizeof at);
    }
  }
  if (!file.flush()) throw FileError("cannot write " + path.string());
}

void export_volume(const VolumeMap& map, const std::filesystem::path& folder) {
  const OccupancyTree tree = map.merged();
  tree.write_bt(folder / "volume.bt");
  tree.write_ot(folder / "volume.ot");
  write_ply(map, folder / "cloud.ply");
}

}  // namespace adit

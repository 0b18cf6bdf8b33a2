// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "tools/survey/files/mesh_file.hpp"

#include <bit>
#include <iterator>

#include <fmt/format.h>

#include "common/files/output_file.hpp"

namespace adit {
namespace {

static_assert(std::endian::native == std::endian::little, "PLY is written in memory order");

template <class T>
void append_raw(T value, std::string& bytes) {
  bytes.append(reinterpret_cast<const char*>(&value), sizeof value);
}

}  // namespace

void write_mesh_ply(const SurfaceMesh& mesh, const std::string& comment,
                    const std::filesystem::path& path) {
  OutputFile file(path);
  file.write(
      fmt::format("ply\nformat binary_little_endian 1.0\ncomment {}\nelement vertex {}\n"
                  "property double x\nproperty double y\nproperty double z\n"
                  "element face {}\nproperty list uchar uint vertex_indices\nend_header\n",
                  comment, mesh.vertices.size(), mesh.triangles.size()));
  std::string bytes;
  for (const Eigen::Vector3d& p : mesh.vertices) {
    for (const double coordinate : p) append_raw(coordinate, bytes);
  }
  for (const auto& triangle : mesh.triangles) {
    append_raw(std::uint8_t{3}, bytes);
    for (const std::uint32_t corner : triangle) append_raw(corner, bytes);
  }
  file.write(bytes);
  file.close();
}

void write_mesh_obj(const SurfaceMesh& mesh, const std::string& comment,
                    const std::filesystem::path& path) {
  OutputFile file(path);
  std::string text = fmt::format("# {}\no void\n", comment);
  for (const Eigen::Vector3d& p : mesh.vertices)
    fmt::format_to(std::back_inserter(text), "v {:.3f} {:.3f} {:.3f}\n", p.x(), p.y(), p.z());
  for (const auto& triangle : mesh.triangles) {
    fmt::format_to(std::back_inserter(text), "f {} {} {}\n", triangle[0] + 1, triangle[1] + 1,
                   triangle[2] + 1);
  }
  file.write(text);
  file.close();
}

}  // namespace adit

// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "sim/mesh/mesh_builder.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <stdexcept>

#include <fmt/format.h>

namespace adit {
namespace {

constexpr std::size_t kPartsMax = std::numeric_limits<std::uint16_t>::max();

void require_room(std::size_t count, const char* what) {
  if (count <= MeshBuilder::kTrianglesMax) return;
  throw std::invalid_argument(
      fmt::format("too many {} in one world: at most {} are possible; make it smaller or coarser",
                  what, MeshBuilder::kTrianglesMax));
}

}  // namespace

void MeshBuilder::begin_part(PartKind kind, Material material, const std::string& name) {
  if (mesh_.parts.size() == kPartsMax) throw std::invalid_argument("too many parts in one world");
  std::string unique = name;
  while (!names_.insert(unique).second) {
    unique = fmt::format("{}_{}", name, ++repeats_[name] + 1);
  }
  mesh_.parts.push_back({kind, material, unique});
}

void MeshBuilder::reassign(
    const std::function<bool(const Part& part, const Eigen::Vector3f& middle)>& is_chosen) {
  for (std::uint32_t i = 0; i < mesh_.triangles.size(); ++i) {
    const auto& [a, b, c] = mesh_.triangles[i];
    const Eigen::Vector3f middle =
        (mesh_.vertices[a] + mesh_.vertices[b] + mesh_.vertices[c]) / 3.0F;
    if (is_chosen(mesh_.part_of(i), middle)) mesh_.triangle_parts[i] = current_part();
  }
}

void MeshBuilder::reserve(std::size_t vertices, std::size_t triangles) {
  require_room(mesh_.vertices.size() + vertices, "vertices");
  require_room(mesh_.triangles.size() + triangles, "triangles");
  mesh_.vertices.reserve(mesh_.vertices.size() + vertices);
  mesh_.triangles.reserve(mesh_.triangles.size() + triangles);
  mesh_.triangle_parts.reserve(mesh_.triangle_parts.size() + triangles);
}

std::uint32_t MeshBuilder::vertex(const Eigen::Vector3f& p_world) {
  require_room(mesh_.vertices.size() + 1, "vertices");
  mesh_.vertices.push_back(p_world);
  return static_cast<std::uint32_t>(mesh_.vertices.size() - 1);
}

void MeshBuilder::triangle(std::uint32_t a, std::uint32_t b, std::uint32_t c) {
  require_room(mesh_.triangles.size() + 1, "triangles");
  mesh_.triangles.push_back({a, b, c});
  mesh_.triangle_parts.push_back(current_part());
}

void MeshBuilder::quad(std::uint32_t a, std::uint32_t b, std::uint32_t c, std::uint32_t d) {
  triangle(a, b, c);
  triangle(a, c, d);
}

void MeshBuilder::box(const OrientedBox& box) {
  std::array<std::uint32_t, 8> corner{};  // bit i of the index selects the upper side along axis i
  for (unsigned i = 0; i < 8; ++i) {
    const Eigen::Vector3d sign((i & 1U) != 0 ? 1.0 : -1.0, (i & 2U) != 0 ? 1.0 : -1.0,
                               (i & 4U) != 0 ? 1.0 : -1.0);
    const Eigen::Vector3d p_world = box.T_world_box * sign.cwiseProduct(box.half_size);
    corner[i] = vertex(p_world.cast<float>());
  }
  quad(corner[0], corner[2], corner[3], corner[1]);
  quad(corner[4], corner[5], corner[7], corner[6]);
  quad(corner[0], corner[1], corner[5], corner[4]);
  quad(corner[2], corner[6], corner[7], corner[3]);
  quad(corner[0], corner[4], corner[6], corner[2]);
  quad(corner[1], corner[3], corner[7], corner[5]);
}

void MeshBuilder::bar(const Eigen::Vector3d& from, const Eigen::Vector3d& to, double radius_m,
                      int sides) {
  const std::array<Eigen::Vector3d, 2> line{from, to};
  tube(line, radius_m, sides);
  const std::array<std::pair<Eigen::Vector3d, Eigen::Vector3d>, 2> ends{std::pair{from, from - to},
                                                                        std::pair{to, to - from}};
  for (const auto& [centre, outwards] : ends) {
    const std::vector<std::uint32_t> rim = ring(centre, outwards, radius_m, sides);
    const std::uint32_t middle = vertex(centre.cast<float>());
    for (std::size_t i = 0; i < rim.size(); ++i) {
      triangle(middle, rim[i], rim[(i + 1) % rim.size()]);
    }
  }
}

void MeshBuilder::tube(std::span<const Eigen::Vector3d> line, double radius_m, int sides) {
  std::vector<std::uint32_t> before;
  for (std::size_t i = 0; i < line.size(); ++i) {
    const Eigen::Vector3d& last = line[i > 0 ? i - 1 : 0];
    const Eigen::Vector3d& next = line[std::min(i + 1, line.size() - 1)];
    const std::vector<std::uint32_t> here = ring(line[i], next - last, radius_m, sides);
    for (std::size_t k = 0; k < before.size(); ++k) {
      const std::size_t l = (k + 1) % before.size();
      quad(before[k], before[l], here[l], here[k]);
    }
    before = here;
  }
}

/// Corners of a regular polygon around an axis, counter-clockwise about it. The first corner varies
/// continuously with the axis, so that rings of similar axes correspond.
std::vector<std::uint32_t> MeshBuilder::ring(const Eigen::Vector3d& centre,
                                             const Eigen::Vector3d& axis, double radius_m,
                                             int sides) {
  const Eigen::Vector3d along = axis.normalized();
  const Eigen::Vector3d aside =
      std::abs(along.z()) < 0.9 ? Eigen::Vector3d::UnitZ() : Eigen::Vector3d::UnitX();
  const Eigen::Vector3d u = aside.cross(along).normalized();
  const Eigen::Vector3d v = along.cross(u);
  std::vector<std::uint32_t> corners;
  for (int i = 0; i < sides; ++i) {
    const double angle = 2.0 * std::numbers::pi * i / sides;
    const Eigen::Vector3d p = centre + radius_m * (std::cos(angle) * u + std::sin(angle) * v);
    corners.push_back(vertex(p.cast<float>()));
  }
  return corners;
}

}  // namespace adit

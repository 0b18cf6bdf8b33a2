// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "sim/mesh/mesh_file.hpp"

#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>
#include <cstdint>
#include <fstream>
#include <span>
#include <sstream>
#include <stdexcept>
#include <string>
#include <string_view>
#include <system_error>
#include <utility>

#include <Eigen/Geometry>
#include <assimp/Importer.hpp>
#include <assimp/config.h>
#include <assimp/postprocess.h>
#include <assimp/scene.h>
#include <fmt/format.h>

#include "common/config/number_text.hpp"
#include "sim/mesh/child_process.hpp"
#include "sim/mesh/mesh_builder.hpp"
#include "sim/mesh/triangle_mesh.hpp"

namespace adit {
namespace {

// Larger than the text form of a mesh with the maximum number of triangles.
constexpr std::uintmax_t kBytesMax = 1'000'000'000;

[[noreturn]] void reject(const std::filesystem::path& file, const std::string& why) {
  throw std::runtime_error(fmt::format("{} is not a mesh: {}", file.string(), why));
}

void check_count(const std::filesystem::path& file, double count, std::uintmax_t bytes) {
  if (count >= 0.0 && count <= static_cast<double>(bytes)) return;
  reject(file, fmt::format("it announces {} elements in {} bytes", number_text(count), bytes));
}

bool is_other_ply_keyword(const std::string& word) {
  return word == "ply" || word == "format" || word == "comment" || word == "obj_info" ||
         word == "property";
}

/// Checks lines `element NAME COUNT` in the header and its end; without an end, Assimp 5.2 loops
/// endlessly.
void check_ply_header(const std::filesystem::path& file, std::uintmax_t bytes) {
  std::ifstream in(file, std::ios::binary);
  for (std::string line; std::getline(in, line);) {
    std::istringstream words(line);
    std::string word;
    std::string name;
    double count = -1.0;
    words >> word;
    if (word == "end_header") return;
    if (word == "element" && words >> name >> count) {
      check_count(file, count, bytes);
    } else if (!is_other_ply_keyword(word)) {
      reject(file, "its header has a line that is not valid in a PLY file");
    }
  }
  reject(file, "its header has no end");
}

/// Checks attributes `count="COUNT"` anywhere in the file.
void check_dae_counts(const std::filesystem::path& file, const std::string& text) {
  constexpr std::string_view kCount = "count=";
  for (std::size_t at = text.find(kCount); at != std::string::npos; at = text.find(kCount, at)) {
    at += kCount.size() + 1;  // and the quotation mark
    if (at >= text.size()) return;
    double count = 0.0;
    if (std::istringstream(text.substr(at, 30)) >> count) check_count(file, count, text.size());
  }
}

/// Checks elements <p>: Assimp 5.2 loops endlessly on an index that is not a number.
void check_dae_indices(const std::filesystem::path& file, const std::string& text) {
  constexpr std::string_view kIndices = "<p>";
  for (std::size_t at = text.find(kIndices); at != std::string::npos;
       at = text.find(kIndices, at)) {
    at = text.find_first_not_of("0123456789 \t\r\n", at + kIndices.size());
    if (at == std::string::npos || text[at] != '<') {
      reject(file, "an index in it is not a number");
    }
  }
}

void check_dae(const std::filesystem::path& file) {
  std::ifstream in(file, std::ios::binary);
  std::ostringstream all;
  all << in.rdbuf();
  const std::string text = all.str();
  check_dae_counts(file, text);
  check_dae_indices(file, text);
}

/// Checks a mesh file before it is read, so that a damaged file cannot exhaust the memory: one that
/// is missing, empty or too large, a PLY file without a header, and a PLY or Collada (.dae) file
/// that announces more elements than its size allows.
void check_mesh_file(const std::filesystem::path& file) {
  std::error_code error;
  if (!std::filesystem::is_regular_file(file, error)) {
    throw std::runtime_error(fmt::format("there is no mesh file {}", file.string()));
  }
  const std::uintmax_t bytes = std::filesystem::file_size(file);
  if (bytes == 0) throw std::runtime_error(fmt::format("{} is empty", file.string()));
  if (bytes > kBytesMax) {
    throw std::runtime_error(
        fmt::format("{} has more than {} bytes: simplify the mesh", file.string(), kBytesMax));
  }
  const std::string ending = file.extension().string();
  if (ending == ".ply") check_ply_header(file, bytes);
  if (ending == ".dae") check_dae(file);
}

struct NamedKind {
  std::string_view word;
  PartKind kind;
  Material material;
};

constexpr std::array<NamedKind, 12> kNamedKinds{{
    {"floor", PartKind::kFloor, Material::kRock},
    {"roof", PartKind::kRoof, Material::kRock},
    {"wall", PartKind::kWall, Material::kRock},
    {"rail", PartKind::kRail, Material::kSteel},
    {"sleeper", PartKind::kSleeper, Material::kTimber},
    {"post", PartKind::kPost, Material::kTimber},
    {"crib", PartKind::kCrib, Material::kTimber},
    {"rubble", PartKind::kRubble, Material::kRock},
    {"beam", PartKind::kBeam, Material::kTimber},
    {"cable", PartKind::kCable, Material::kSteel},
    {"car", PartKind::kCar, Material::kSteel},
    {"water", PartKind::kWater, Material::kWater},
}};

/// By the first keyword that is in the name.
std::pair<PartKind, Material> classify_surface(std::string name) {
  std::transform(name.begin(), name.end(), name.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  const auto* named = std::find_if(
      kNamedKinds.begin(), kNamedKinds.end(),
      [&](const NamedKind& candidate) { return name.find(candidate.word) != std::string::npos; });
  if (named == kNamedKinds.end()) return {PartKind::kOther, Material::kRock};
  return {named->kind, named->material};
}

// Maximum extent of a mine [m].
constexpr double kSizeMin = 1.0;
constexpr double kSizeMax = 20000.0;
// Limit of processor time, sufficient for a file of the maximum size.
constexpr int kSecondsMax = 60;

/// Transform from the axes and units of the file to world.
Eigen::Matrix3d to_world(const MeshFileParams& params) {
  Eigen::Matrix3d rotation = Eigen::Matrix3d::Identity();
  if (params.up == 'y') rotation << 1.0, 0.0, 0.0, 0.0, 0.0, -1.0, 0.0, 1.0, 0.0;
  if (params.up == 'x') rotation << 0.0, 1.0, 0.0, 0.0, 0.0, 1.0, 1.0, 0.0, 0.0;
  return params.scale * rotation;
}

Eigen::Affine3d to_eigen(const aiMatrix4x4& m) {
  Eigen::Affine3d T;
  T.matrix() << m.a1, m.a2, m.a3, m.a4, m.b1, m.b2, m.b3, m.b4, m.c1, m.c2, m.c3, m.c4, 0.0, 0.0,
      0.0, 1.0;
  return T;
}

/// Collects the meshes of a scene.
class Collector {
 public:
  void add(const aiScene& scene, const aiNode& node, const Eigen::Affine3d& T_world_parent) {
    const Eigen::Affine3d T_world_node = T_world_parent * to_eigen(node.mTransformation);
    for (unsigned i = 0; i < node.mNumMeshes; ++i) {
      add(*scene.mMeshes[node.mMeshes[i]], node.mName.C_Str(), T_world_node);
    }
    for (unsigned i = 0; i < node.mNumChildren; ++i) add(scene, *node.mChildren[i], T_world_node);
  }

  [[nodiscard]] const Eigen::AlignedBox3d& box() const { return box_; }
  TriangleMesh take() { return builder_.take(); }

 private:
  void add(const aiMesh& mesh, const std::string& node_name, const Eigen::Affine3d& T_world_mesh) {
    const std::string name = mesh.mName.length > 0 ? mesh.mName.C_Str() : node_name;
    const auto [kind, material] = classify_surface(name);
    builder_.begin_part(kind, material, name.empty() ? "mesh" : name);
    std::vector<Eigen::Vector3d> places;
    const auto first = static_cast<std::uint32_t>(builder_.mesh().vertices.size());
    for (unsigned i = 0; i < mesh.mNumVertices; ++i) {
      const aiVector3D& v = mesh.mVertices[i];
      places.emplace_back(T_world_mesh * Eigen::Vector3d(v.x, v.y, v.z));
      builder_.vertex(places.back().cast<float>());
    }
    for (unsigned i = 0; i < mesh.mNumFaces; ++i) add(mesh.mFaces[i], places, first);
  }

  void add(const aiFace& face, const std::vector<Eigen::Vector3d>& places, std::uint32_t first) {
    if (face.mNumIndices != 3) return;  // a point or a line
    const auto* index = face.mIndices;
    if (std::any_of(index, index + 3, [&](unsigned i) { return i >= places.size(); })) return;
    const Eigen::Vector3d& a = places[index[0]];
    const Eigen::Vector3d& b = places[index[1]];
    const Eigen::Vector3d& c = places[index[2]];
    const double area = (b - a).cross(c - a).norm();
    if (!std::isfinite(area) || area == 0.0) return;
    builder_.triangle(first + index[0], first + index[1], first + index[2]);
    for (const Eigen::Vector3d& corner : {a, b, c}) box_.extend(corner);
  }

  MeshBuilder builder_;
  Eigen::AlignedBox3d box_;
};

void check_size(const std::filesystem::path& file, const Eigen::AlignedBox3d& box, double scale) {
  if (box.isEmpty()) {
    throw std::runtime_error(fmt::format("{} has no triangle with an area", file.string()));
  }
  const double size = box.sizes().maxCoeff();
  const double farthest =
      std::max(box.min().cwiseAbs().maxCoeff(), box.max().cwiseAbs().maxCoeff());
  if (size < kSizeMin || size > kSizeMax) {
    throw std::runtime_error(
        fmt::format("{} is {:g} m long with scale {:g}: "
                    "set `scale` to the metres of one unit of the file",
                    file.string(), size, scale));
  }
  if (farthest > kSizeMax) {
    throw std::runtime_error(
        fmt::format("{} lies {:g} m from its origin with scale {:g}: "
                    "move it nearer, or set `scale` to the metres of one unit of the file",
                    file.string(), farthest, scale));
  }
}

/// Assimp 5.2 reads beyond the vertices when it triangulates such polygons.
void check_indices(const std::filesystem::path& file, const aiMesh& mesh) {
  for (const aiFace& face : std::span(mesh.mFaces, mesh.mNumFaces)) {
    const std::span indices(face.mIndices, face.mNumIndices);
    if (std::ranges::all_of(indices, [&](unsigned i) { return i < mesh.mNumVertices; })) continue;
    reject(file, "a face refers to a missing vertex");
  }
}

/// Sets the flag for polygons of each mesh. Some readers set it for meshes without polygons, on
/// which the triangulation of Assimp 5.2 aborts.
void correct_primitive_types(const aiScene& scene) {
  for (unsigned i = 0; i < scene.mNumMeshes; ++i) {
    aiMesh& mesh = *scene.mMeshes[i];
    const bool polygons = std::any_of(mesh.mFaces, mesh.mFaces + mesh.mNumFaces,
                                      [](const aiFace& face) { return face.mNumIndices > 3; });
    mesh.mPrimitiveTypes = aiPrimitiveType_TRIANGLE;
    if (polygons) mesh.mPrimitiveTypes |= aiPrimitiveType_POLYGON;
  }
}

/// The error text of Assimp may have several lines.
std::string first_line(const std::string& text) { return text.substr(0, text.find('\n')); }

/// A damaged file may crash Assimp or make it loop endlessly.
TriangleMesh read_with_assimp(const std::filesystem::path& file, const MeshFileParams& params) {
  Assimp::Importer importer;
  importer.SetPropertyBool(AI_CONFIG_IMPORT_COLLADA_IGNORE_UP_DIRECTION, true);
  importer.SetPropertyInteger(AI_CONFIG_PP_RVC_FLAGS,
                              aiComponent_NORMALS | aiComponent_TANGENTS_AND_BITANGENTS |
                                  aiComponent_COLORS | aiComponent_TEXCOORDS |
                                  aiComponent_MATERIALS | aiComponent_TEXTURES);
  const aiScene* scene = importer.ReadFile(file.string(), 0);
  if (scene != nullptr) {
    for (const aiMesh* mesh : std::span(scene->mMeshes, scene->mNumMeshes)) {
      check_indices(file, *mesh);
    }
    correct_primitive_types(*scene);
    scene = importer.ApplyPostProcessing(aiProcess_Triangulate | aiProcess_RemoveComponent |
                                         aiProcess_JoinIdenticalVertices);
  }
  if (scene == nullptr || scene->mRootNode == nullptr) {
    reject(file, first_line(importer.GetErrorString()));
  }
  Collector collector;
  collector.add(*scene, *scene->mRootNode, Eigen::Affine3d(to_world(params)));
  check_size(file, collector.box(), params.scale);
  return collector.take();
}

}  // namespace

TriangleMesh load_mesh_file(const std::filesystem::path& file, const MeshFileParams& params) {
  check_mesh_file(file);
  const auto read = [&] { return to_bytes(read_with_assimp(file, params)); };
  try {
    return mesh_from_bytes(run_in_child_process(read, kSecondsMax));
  } catch (const ChildProcessError& death) {
    reject(file, death.what());
  }
}

}  // namespace adit

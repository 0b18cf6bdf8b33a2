// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "sim/mesh/ray_scene.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <utility>

#include <embree3/rtcore.h>
#include <fmt/format.h>

namespace adit {
namespace {

// Ranges differ in their last bits between instruction sets, so one is fixed.
constexpr const char* kDevice = "threads=1,isa=avx2";
constexpr std::size_t kPacket = 8;  // the width of the instruction set
constexpr float kInfinity = std::numeric_limits<float>::infinity();
const RayHit kNoHit{kInfinity, 0, Eigen::Vector3f::Zero()};
// Offset at which a ray continues behind water; at 1 km, the spacing of floats may exceed it.
constexpr float kBehindWater = 1e-4F;

struct ReleaseDevice {
  void operator()(RTCDevice device) const { rtcReleaseDevice(device); }
};
struct ReleaseScene {
  void operator()(RTCScene scene) const { rtcReleaseScene(scene); }
};
using Device = std::unique_ptr<std::remove_pointer_t<RTCDevice>, ReleaseDevice>;
using Scene = std::unique_ptr<std::remove_pointer_t<RTCScene>, ReleaseScene>;

bool is_water(const TriangleMesh& mesh, std::uint32_t triangle) {
  const Material material = mesh.part_of(triangle).material;
  return material == Material::kWater || material == Material::kMirror;
}

/// Embree's normal has any length and points to either side.
Eigen::Vector3f facing_normal(const Eigen::Vector3f& Ng, const Eigen::Vector3f& direction) {
  const Eigen::Vector3f normal = Ng.normalized();
  return normal.dot(direction) > 0.0F ? Eigen::Vector3f(-normal) : normal;
}

/// Result of the callback of a point query.
struct Touching {
  const TriangleMesh& mesh;
  const OrientedBox& box;
  std::vector<std::uint32_t> triangles;
};

bool add_if_touching(RTCPointQueryFunctionArguments* arguments) {
  auto& found = *static_cast<Touching*>(arguments->userPtr);
  const std::uint32_t triangle = arguments->primID;
  if (is_water(found.mesh, triangle)) return false;
  const auto& [a, b, c] = found.mesh.triangles[triangle];
  const std::array<Eigen::Vector3d, 3> corners{found.mesh.vertices[a].cast<double>(),
                                               found.mesh.vertices[b].cast<double>(),
                                               found.mesh.vertices[c].cast<double>()};
  if (overlaps(found.box, corners)) found.triangles.push_back(triangle);
  return false;  // do not change the radius of the query
}

}  // namespace

class RayScene::Impl {
 public:
  explicit Impl(const TriangleMesh& mesh) : mesh_(mesh), device_(rtcNewDevice(kDevice)) {
    if (!device_) throw std::runtime_error("Embree does not start on this processor");
    scene_.reset(rtcNewScene(device_.get()));
    rtcSetSceneFlags(scene_.get(), RTC_SCENE_FLAG_ROBUST);
    rtcSetSceneBuildQuality(scene_.get(), RTC_BUILD_QUALITY_MEDIUM);
    if (!mesh.triangles.empty()) attach_mesh();
    rtcCommitScene(scene_.get());
    if (rtcGetDeviceError(device_.get()) != RTC_ERROR_NONE) {
      throw std::runtime_error(
          fmt::format("Embree cannot take a mesh of {} triangles", mesh.triangles.size()));
    }
  }

  /// The first hit beyond `from_m`.
  [[nodiscard]] std::optional<RayHit> cast(const Ray& ray, float from_m, float range_max_m,
                                           Layer layer) const {
    while (true) {
      RTCRayHit query = make_query(ray, from_m, range_max_m);
      RTCIntersectContext context;
      rtcInitIntersectContext(&context);
      rtcIntersect1(scene_.get(), &context, &query);
      if (query.hit.geomID == RTC_INVALID_GEOMETRY_ID) return std::nullopt;
      if (is_in(layer, query.hit.primID)) {
        const Eigen::Vector3f Ng(query.hit.Ng_x, query.hit.Ng_y, query.hit.Ng_z);
        return RayHit{query.ray.tfar, query.hit.primID, facing_normal(Ng, ray.direction)};
      }
      from_m = std::max(query.ray.tfar + kBehindWater, std::nextafter(query.ray.tfar, kInfinity));
    }
  }

  void cast(std::span<const Ray> rays, float range_max_m, std::span<RayHit> hits,
            Layer layer) const {
    for (std::size_t start = 0; start < rays.size(); start += kPacket) {
      const std::size_t n = std::min(kPacket, rays.size() - start);
      cast_packet(rays.subspan(start, n), range_max_m, hits.subspan(start, n));
    }
    if (layer == Layer::kOptical) return;
    for (std::size_t i = 0; i < rays.size(); ++i) {
      if (hits[i].distance_m == kInfinity || is_in(layer, hits[i].triangle)) continue;
      const float from_m = hits[i].distance_m + kBehindWater;
      hits[i] = cast(rays[i], from_m, range_max_m, layer).value_or(kNoHit);
    }
  }

  [[nodiscard]] std::vector<std::uint32_t> touching(const OrientedBox& box) const {
    Touching found{mesh_, box, {}};
    const Eigen::Vector3f centre = box.T_world_box.translation().cast<float>();
    RTCPointQuery query{centre.x(), centre.y(), centre.z(), 0.0F,
                        static_cast<float>(box.half_size.norm())};
    RTCPointQueryContext context;
    rtcInitPointQueryContext(&context);
    rtcPointQuery(scene_.get(), &query, &context, &add_if_touching, &found);
    std::sort(found.triangles.begin(), found.triangles.end());
    return std::move(found.triangles);
  }

  [[nodiscard]] const TriangleMesh& mesh() const { return mesh_; }

 private:
  [[nodiscard]] bool is_in(Layer layer, std::uint32_t triangle) const {
    return layer == Layer::kOptical || !is_water(mesh_, triangle);
  }

  void attach_mesh() {
    const RTCGeometry geometry = rtcNewGeometry(device_.get(), RTC_GEOMETRY_TYPE_TRIANGLE);
    auto* vertices = static_cast<float*>(
        rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3,
                                sizeof(Eigen::Vector3f), mesh_.vertices.size()));
    auto* indices = static_cast<std::uint32_t*>(
        rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3,
                                sizeof(TriangleMesh::Triangle), mesh_.triangles.size()));
    if (vertices == nullptr || indices == nullptr) throw std::bad_alloc();
    for (const Eigen::Vector3f& vertex : mesh_.vertices) {
      vertices = std::copy(vertex.data(), vertex.data() + 3, vertices);
    }
    for (const auto& triangle : mesh_.triangles) {
      indices = std::copy(triangle.begin(), triangle.end(), indices);
    }
    rtcCommitGeometry(geometry);
    rtcAttachGeometry(scene_.get(), geometry);
    rtcReleaseGeometry(geometry);
  }

  static RTCRayHit make_query(const Ray& ray, float from, float to) {
    RTCRayHit query{};
    query.ray = {ray.origin.x(),
                 ray.origin.y(),
                 ray.origin.z(),
                 from,
                 ray.direction.x(),
                 ray.direction.y(),
                 ray.direction.z(),
                 0.0F,
                 to,
                 ~0U,
                 0U,
                 0U};
    query.hit.geomID = RTC_INVALID_GEOMETRY_ID;
    return query;
  }

  void cast_packet(std::span<const Ray> rays, float range_max_m, std::span<RayHit> hits) const {
    alignas(64) RTCRayHit8 query{};
    alignas(64) std::array<int, kPacket> valid{};
    for (std::size_t i = 0; i < rays.size(); ++i) {
      valid[i] = -1;
      query.ray.org_x[i] = rays[i].origin.x();
      query.ray.org_y[i] = rays[i].origin.y();
      query.ray.org_z[i] = rays[i].origin.z();
      query.ray.dir_x[i] = rays[i].direction.x();
      query.ray.dir_y[i] = rays[i].direction.y();
      query.ray.dir_z[i] = rays[i].direction.z();
      query.ray.tfar[i] = range_max_m;
      query.ray.mask[i] = ~0U;
      query.hit.geomID[i] = RTC_INVALID_GEOMETRY_ID;
    }
    // Not marked as coherent: with that flag, Embree 3.13 misses about one hit in several thousand.
    RTCIntersectContext context;
    rtcInitIntersectContext(&context);
    rtcIntersect8(valid.data(), scene_.get(), &context, &query);
    for (std::size_t i = 0; i < rays.size(); ++i) {
      if (query.hit.geomID[i] == RTC_INVALID_GEOMETRY_ID) {
        hits[i] = kNoHit;
        continue;
      }
      const Eigen::Vector3f Ng(query.hit.Ng_x[i], query.hit.Ng_y[i], query.hit.Ng_z[i]);
      hits[i] = {query.ray.tfar[i], query.hit.primID[i], facing_normal(Ng, rays[i].direction)};
    }
  }

  const TriangleMesh& mesh_;
  Device device_;
  Scene scene_;
};

RayScene::RayScene(const TriangleMesh& mesh) : impl_(std::make_unique<Impl>(mesh)) {}
RayScene::~RayScene() = default;
RayScene::RayScene(RayScene&&) noexcept = default;
RayScene& RayScene::operator=(RayScene&&) noexcept = default;

std::optional<RayHit> RayScene::cast(const Ray& ray, float range_max_m, Layer layer) const {
  return impl_->cast(ray, 0.0F, range_max_m, layer);
}

void RayScene::cast(std::span<const Ray> rays, float range_max_m, std::span<RayHit> hits,
                    Layer layer) const {
  impl_->cast(rays, range_max_m, hits, layer);
}

std::vector<std::uint32_t> RayScene::touching(const OrientedBox& box) const {
  return impl_->touching(box);
}

const TriangleMesh& RayScene::mesh() const { return impl_->mesh(); }

namespace {

using Corners = std::array<Eigen::Vector3d, 3>;

/// Whether the axis separates the triangle from the box at the origin.
bool separates(const Eigen::Vector3d& axis, const Corners& corners, const Eigen::Vector3d& half) {
  const double reach = half.dot(axis.cwiseAbs());
  const auto [low, high] =
      std::minmax({axis.dot(corners[0]), axis.dot(corners[1]), axis.dot(corners[2])});
  return low > reach || high < -reach;
}

}  // namespace

bool overlaps(const OrientedBox& box, const std::array<Eigen::Vector3d, 3>& triangle) {
  const Eigen::Isometry3d T_box_world = box.T_world_box.inverse();
  Corners corners;
  for (std::size_t i = 0; i < 3; ++i) {
    corners[i] = T_box_world * triangle[i];
    if (!corners[i].allFinite()) return false;
  }
  const Corners edges{corners[1] - corners[0], corners[2] - corners[1], corners[0] - corners[2]};
  for (int axis = 0; axis < 3; ++axis) {
    const Eigen::Vector3d unit = Eigen::Vector3d::Unit(axis);
    if (separates(unit, corners, box.half_size)) return false;
    for (const Eigen::Vector3d& edge : edges) {
      if (separates(unit.cross(edge), corners, box.half_size)) return false;
    }
  }
  return !separates(edges[0].cross(edges[1]), corners, box.half_size);
}

}  // namespace adit

// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "sim/world/surface/mine_surface.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <utility>

#include <Eigen/Core>

#include "sim/world/surface/plan_mesh.hpp"

namespace adit {
namespace {

// The bulge of a wall grows from 0 at floor and roof to its full size over this fraction of the
// height.
constexpr double kShareToBulge = 0.2;

/// Normal to the line between the neighbours.
std::vector<Eigen::Vector2d> directions_into_open(const PlanMesh& plan) {
  std::vector<Eigen::Vector2d> directions(plan.points.size(), Eigen::Vector2d::Zero());
  std::vector<std::uint32_t> before(plan.points.size(), PlanMesh::kNone);
  for (std::uint32_t i = 0; i < before.size(); ++i) {
    if (plan.is_on_wall(i)) before[plan.next_on_wall[i]] = i;
  }
  for (std::uint32_t i = 0; i < before.size(); ++i) {
    if (!plan.is_on_wall(i)) continue;
    const Eigen::Vector2d along = plan.points[plan.next_on_wall[i]] - plan.points[before[i]];
    directions[i] = Eigen::Vector2d(-along.y(), along.x()).normalized();
  }
  return directions;
}

/// The walls of a mine between floor and roof: vertical above the points of a plan, with the bulges
/// of the open space. Frame world.
class WallShape {
 public:
  /// Heights of floor and roof are those of each point of the plan. All must outlive this.
  WallShape(const OpenSpace& space, const PlanMesh& plan, const std::vector<double>& floor_m,
            const std::vector<double>& roof_m)
      : space_(space),
        plan_(plan),
        floor_m_(floor_m),
        roof_m_(roof_m),
        into_open_(directions_into_open(plan)) {}

  /// The point of the wall above a wall point of the plan, at a fraction of the height from floor
  /// to roof.
  [[nodiscard]] Eigen::Vector3d at(std::uint32_t point, double share) const {
    const Eigen::Vector2d& p = plan_.points[point];
    const Eigen::Vector3d upright(p.x(), p.y(), std::lerp(floor_m_[point], roof_m_[point], share));
    const double grown = std::min(1.0, std::min(share, 1.0 - share) / kShareToBulge);
    const Eigen::Vector2d back = -grown * space_.bulge_m(upright) * into_open_[point];
    return upright + Eigen::Vector3d(back.x(), back.y(), 0.0);
  }

 private:
  const OpenSpace& space_;
  const PlanMesh& plan_;
  const std::vector<double>& floor_m_;
  const std::vector<double>& roof_m_;
  std::vector<Eigen::Vector2d> into_open_;  ///< for each point: unit, away from the wall
};

/// Evaluates a function of the plan at each of its points.
template <class Function>
auto at_points(const PlanMesh& plan, const Function& function) {
  std::vector<decltype(function(plan.points[0]))> values;
  values.reserve(plan.points.size());
  for (const Eigen::Vector2d& p : plan.points) values.push_back(function(p));
  return values;
}

/// Floor, roof and walls over one triangulation of the plan.
class SurfaceBuilder {
 public:
  SurfaceBuilder(const OpenSpace& space, const Heights& heights, int wall_rows, PlanMesh plan,
                 const OwnedPart& part, SharedVertices& shared, MeshBuilder& builder)
      : wall_rows_(wall_rows),
        plan_(std::move(plan)),
        part_(part),
        shared_(shared),
        builder_(builder),
        outside_(at_points(plan_, [&](const auto& p) { return space.on_apron(p); })),
        floor_m_(at_points(plan_, [&](const auto& p) { return heights.floor(p); })),
        roof_m_(at_points(plan_, [&](const auto& p) { return heights.roof(p); })),
        walls_(space, plan_, floor_m_, roof_m_) {}

  void add() {
    choose_owned();
    reserve();
    add_floor();
    add_roof();
    add_columns();
    add_walls();
    share();
  }

  /// Follows each closed wall once.
  [[nodiscard]] std::vector<PlanRing> outlines() const {
    std::vector<PlanRing> rings;
    std::vector<bool> done(plan_.points.size(), false);
    for (std::uint32_t start = 0; start < done.size(); ++start) {
      PlanRing ring;
      for (std::uint32_t i = start; plan_.is_on_wall(i) && !done[i]; i = plan_.next_on_wall[i]) {
        done[i] = true;
        if (!outside_[i]) ring.points.push_back(outline_point(i));
      }
      if (ring.points.size() > 2) rings.push_back(std::move(ring));
    }
    return rings;
  }

 private:
  /// Keeps the triangles of the part, and the walls at their edges.
  void choose_owned() {
    wall_is_owned_.assign(plan_.points.size(), false);
    point_is_owned_.assign(plan_.points.size(), false);
    std::erase_if(plan_.triangles, [&](const auto& triangle) {
      const auto& [a, b, c] = triangle;
      const Eigen::Vector2d middle = (plan_.points[a] + plan_.points[b] + plan_.points[c]) / 3.0;
      if (!part_.owns(middle)) return true;
      for (std::size_t i = 0; i < 3; ++i) {
        const std::uint32_t from = triangle[i];
        point_is_owned_[from] = true;
        if (plan_.next_on_wall[from] == triangle[(i + 1) % 3]) wall_is_owned_[from] = true;
      }
      return false;
    });
  }

  /// The vertices of a point that another plan has, too.
  [[nodiscard]] const std::array<std::uint32_t, 3>* shared_at(std::size_t point) const {
    const Eigen::Vector2d& p = plan_.points[point];
    if (shared_.empty() || !part_.is_shared(p)) return nullptr;
    const auto found = shared_.find({p.x(), p.y()});
    return found == shared_.end() ? nullptr : &found->second;
  }

  /// Offers the vertices where plans overlap to the others.
  void share() {
    for (std::size_t i = 0; i < plan_.points.size(); ++i) {
      const Eigen::Vector2d& p = plan_.points[i];
      if (!point_is_owned_[i] || !part_.is_shared(p)) continue;
      shared_.insert({{p.x(), p.y()}, {floor_[i], roof_[i], columns_[i]}});
    }
  }

  void reserve() {
    const std::size_t points = plan_.points.size();
    const auto walls = static_cast<std::size_t>(
        std::count_if(plan_.next_on_wall.begin(), plan_.next_on_wall.end(),
                      [](std::uint32_t next) { return next != PlanMesh::kNone; }));
    const auto rows = static_cast<std::size_t>(wall_rows_);
    builder_.reserve(2 * points + walls * rows, 2 * plan_.triangles.size() + 2 * walls * rows);
  }

  /// A vertex over each point of the plan; `which` of its shared vertices instead, if there are.
  std::vector<std::uint32_t> add_vertices(const std::vector<double>& z_m, std::size_t which) {
    std::vector<std::uint32_t> indices;
    for (std::size_t i = 0; i < plan_.points.size(); ++i) {
      const Eigen::Vector2d& p = plan_.points[i];
      const auto* shared = shared_at(i);
      if (shared != nullptr || !point_is_owned_[i]) {
        indices.push_back(shared != nullptr ? (*shared)[which] : PlanMesh::kNone);
        continue;
      }
      indices.push_back(builder_.vertex(Eigen::Vector3d(p.x(), p.y(), z_m[i]).cast<float>()));
    }
    return indices;
  }

  void add_floor() {
    builder_.begin_part(PartKind::kFloor, Material::kRock, "floor");
    floor_ = add_vertices(floor_m_, 0);
    for (const auto& [a, b, c] : plan_.triangles) {
      builder_.triangle(floor_[a], floor_[b], floor_[c]);
    }
  }

  void add_roof() {
    builder_.begin_part(PartKind::kRoof, Material::kRock, "roof");
    roof_ = add_vertices(roof_m_, 1);
    for (const auto& [a, b, c] : plan_.triangles) {
      if (outside_[a] && outside_[b] && outside_[c]) continue;
      builder_.triangle(roof_[a], roof_[c], roof_[b]);
    }
  }

  /// The vertices between floor and roof.
  void add_columns() {
    builder_.begin_part(PartKind::kWall, Material::kRock, "walls");
    columns_.assign(plan_.points.size(), PlanMesh::kNone);
    for (std::uint32_t i = 0; i < columns_.size(); ++i) {
      if (!plan_.is_on_wall(i) || !point_is_owned_[i]) continue;
      if (const auto* shared = shared_at(i)) {
        columns_[i] = (*shared)[2];
        continue;
      }
      for (int row = 1; row < wall_rows_; ++row) {
        const double share = static_cast<double>(row) / wall_rows_;
        const std::uint32_t index = builder_.vertex(walls_.at(i, share).cast<float>());
        if (row == 1) columns_[i] = index;
      }
    }
  }

  [[nodiscard]] std::uint32_t wall_vertex(std::uint32_t i, int row) const {
    if (row == 0) return floor_[i];
    if (row == wall_rows_) return roof_[i];
    return columns_[i] + static_cast<std::uint32_t>(row - 1);
  }

  void add_walls() {
    for (std::uint32_t i = 0; i < plan_.points.size(); ++i) {
      if (!plan_.is_on_wall(i) || !wall_is_owned_[i]) continue;
      const std::uint32_t j = plan_.next_on_wall[i];
      if (outside_[i] && outside_[j]) continue;
      for (int row = 0; row < wall_rows_; ++row) {
        builder_.quad(wall_vertex(j, row), wall_vertex(i, row), wall_vertex(i, row + 1),
                      wall_vertex(j, row + 1));
      }
    }
  }

  /// Position of the wall in the mesh at the height of the outlines, below the roof.
  [[nodiscard]] Eigen::Vector2d outline_point(std::uint32_t i) const {
    const double row = std::min(kOutlineHeight / (roof_m_[i] - floor_m_[i]), 1.0) * wall_rows_;
    const double below = std::min(std::floor(row), wall_rows_ - 1.0);
    const Eigen::Vector3d low = walls_.at(i, below / wall_rows_);
    const Eigen::Vector3d high = walls_.at(i, (below + 1.0) / wall_rows_);
    return (low + (row - below) * (high - low)).head<2>();
  }

  int wall_rows_;
  PlanMesh plan_;
  const OwnedPart& part_;
  SharedVertices& shared_;
  MeshBuilder& builder_;

  // For each point of the plan:
  std::vector<bool> outside_;  ///< under the open sky
  std::vector<double> floor_m_;
  std::vector<double> roof_m_;
  WallShape walls_;
  std::vector<bool> point_is_owned_;  ///< a corner of a triangle of the part
  std::vector<bool> wall_is_owned_;   ///< the wall from it to the next point
  std::vector<std::uint32_t> floor_;  ///< vertices
  std::vector<std::uint32_t> roof_;
  std::vector<std::uint32_t> columns_;  ///< first vertex above the floor
};

}  // namespace

std::vector<PlanRing> add_mine_surface(const OpenSpace& space, const Heights& heights,
                                       double grid_m, double clearance_m, MeshBuilder& builder) {
  const OwnedPart all{[](const Eigen::Vector2d&) { return true; },
                      [](const Eigen::Vector2d&) { return false; }};
  SharedVertices none;
  return add_mine_surface(space, heights, grid_m, clearance_m, all, none, builder);
}

std::vector<PlanRing> add_mine_surface(const OpenSpace& space, const Heights& heights,
                                       double grid_m, double clearance_m, const OwnedPart& part,
                                       SharedVertices& shared, MeshBuilder& builder) {
  const int wall_rows = std::max(1, static_cast<int>(std::lround(clearance_m / grid_m)));
  SurfaceBuilder surface(space, heights, wall_rows, plan_mesh(space, grid_m), part, shared,
                         builder);
  surface.add();
  return surface.outlines();
}

}  // namespace adit

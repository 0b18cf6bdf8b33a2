// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <functional>

#include "common/cloud/cloud.hpp"
#include "common/terrain/terrain_map.hpp"
#include "sim/mesh/mesh_builder.hpp"

namespace adit {

/// What a vehicle at the origin, looking along x, sees of what `add` builds. Its floor is z = 0
/// below it; `T_world_body` may tilt it.
Cloud cloud_of(const std::function<void(MeshBuilder&)>& add,
               const Eigen::Isometry3d& T_world_body = Eigen::Isometry3d::Identity());

/// The ground from x = `from_m` to `to_m`, 4 m wide, its upper side at z = `top_m`.
void add_ground(MeshBuilder& builder, double from_m, double to_m, double top_m = 0.0);
/// A drift 30 m long, 4 m wide and 2 m high with the vehicle in its middle.
void add_drift(MeshBuilder& builder);
void add_rock(MeshBuilder& builder, const Eigen::Vector3d& middle, const Eigen::Vector3d& size);

/// The cell around a place in level [m].
const TerrainCell& cell_at(const TerrainMap& map, double x, double y);

/// Visits all cells whose middle is within a rectangle in level [m].
void for_cells(const TerrainMap& map, const Eigen::AlignedBox2d& box,
               const std::function<void(const TerrainCell&)>& visit);
/// Share of these cells of which something is true.
double share_of(const TerrainMap& map, const Eigen::AlignedBox2d& box,
                const std::function<bool(const TerrainCell&)>& is);

}  // namespace adit

// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "common/types/cloud.hpp"
#include "sim/sweep/tilt_sweep.hpp"
#include "tests/support/worlds/box_tunnel.hpp"

namespace adit::test {

/// Sweep of the front laser at the start of a tunnel that is free, or blocked by rubble 3.2 m
/// ahead.
inline Cloud swept_tunnel(bool free) {
  const Site site(free ? box_tunnel() : box_tunnel({}, [](MeshBuilder& builder) {
    builder.begin_part(PartKind::kWall, Material::kRock, "rubble");
    builder.box(level_box({3.2, 0.0, 0.4}, {0.6, 4.0, 0.8}));
  }));
  Cloud cloud = tilt_sweep(site, Eigen::Isometry3d::Identity());
  cloud.id = 7;
  return cloud;
}

}  // namespace adit::test

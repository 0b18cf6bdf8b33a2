// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "sim/mesh/mesh_builder.hpp"

#include <gtest/gtest.h>

namespace adit {
namespace {

TEST(MeshBuilder, NumbersDuplicateNames) {
  MeshBuilder builder;
  for (const char* name : {"post", "post_2", "post", "post"}) {
    builder.begin_part(PartKind::kPost, Material::kTimber, name);
  }
  const std::vector<Part>& parts = builder.mesh().parts;
  EXPECT_EQ(parts[0].name, "post");
  EXPECT_EQ(parts[1].name, "post_2");
  EXPECT_EQ(parts[2].name, "post_3");
  EXPECT_EQ(parts[3].name, "post_4");
}

TEST(MeshBuilder, ReassignsSelectedTriangles) {
  MeshBuilder builder;
  builder.begin_part(PartKind::kFloor, Material::kRock, "floor");
  for (const float x : {0.0F, 10.0F}) {
    const std::uint32_t a = builder.vertex({x, 0.0F, 0.0F});
    builder.triangle(a, builder.vertex({x + 3.0F, 0.0F, 0.0F}), builder.vertex({x, 3.0F, 0.0F}));
  }
  builder.begin_part(PartKind::kFloor, Material::kMud, "mud");
  builder.reassign([](const Part& part, const Eigen::Vector3f& middle) {
    EXPECT_EQ(part.name, "floor");
    EXPECT_EQ(middle.y(), 1.0F);
    return middle.x() == 11.0F;
  });
  EXPECT_EQ(builder.mesh().part_of(0).name, "floor");
  EXPECT_EQ(builder.mesh().part_of(1).name, "mud");
}

}  // namespace
}  // namespace adit

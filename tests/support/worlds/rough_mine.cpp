// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "tests/support/worlds/rough_mine.hpp"

#include <array>
#include <cmath>
#include <random>

#include "sim/mesh/mesh_builder.hpp"

namespace adit {
namespace {

/// A lattice of `grid_m` whose vertices are displaced at random; surfaces consist of its faces.
class Lattice {
 public:
  Lattice(const RoughMine& mine, MeshBuilder& builder)
      : layers_(static_cast<int>(std::lround(mine.height_m / mine.grid_m))),
        per_spacing_(static_cast<int>(std::lround(mine.spacing_m / mine.grid_m))),
        side_(mine.pillars * per_spacing_ + per_spacing_ / 4),
        builder_(builder) {
    std::mt19937_64 random(1);
    std::uniform_real_distribution<double> rough(-mine.roughness_m, mine.roughness_m);
    for (int z = 0; z <= layers_; ++z) {
      for (int y = 0; y <= side_; ++y) {
        for (int x = 0; x <= side_; ++x) {
          Eigen::Vector3d p = mine.grid_m * Eigen::Vector3d(x, y, z);
          for (double& coordinate : p) coordinate += rough(random);
          builder.vertex(p.cast<float>());
        }
      }
    }
  }

  void add_surfaces(int z) {
    for (int y = 0; y < side_; ++y) {
      for (int x = 0; x < side_; ++x) {
        if (open(x, y)) quad(corner(x, y, z), 1, side_ + 1);
      }
    }
  }

  void add_walls() {
    const int up = (side_ + 1) * (side_ + 1);
    for (int y = 0; y <= side_; ++y) {
      for (int x = 0; x <= side_; ++x) {
        for (int z = 0; z < layers_; ++z) {
          if (open(x, y) != open(x - 1, y)) quad(corner(x, y, z), side_ + 1, up);
          if (open(x, y) != open(x, y - 1)) quad(corner(x, y, z), 1, up);
        }
      }
    }
  }

  [[nodiscard]] int layers() const { return layers_; }

 private:
  [[nodiscard]] bool open(int x, int y) const {
    if (x < 0 || y < 0 || x >= side_ || y >= side_) return false;
    return x % per_spacing_ < per_spacing_ / 4 || y % per_spacing_ < per_spacing_ / 4;
  }
  [[nodiscard]] int corner(int x, int y, int z) const {
    return (z * (side_ + 1) + y) * (side_ + 1) + x;
  }
  void quad(int at, int first_step, int second_step) {
    const auto id = [](int i) { return static_cast<std::uint32_t>(i); };
    builder_.quad(id(at), id(at + first_step), id(at + first_step + second_step),
                  id(at + second_step));
  }

  int layers_;
  int per_spacing_;
  int side_;
  MeshBuilder& builder_;
};

}  // namespace

TriangleMesh rough_mine(const RoughMine& mine) {
  MeshBuilder builder;
  Lattice lattice(mine, builder);
  builder.begin_part(PartKind::kFloor, Material::kRock, "floor");
  lattice.add_surfaces(0);
  builder.begin_part(PartKind::kRoof, Material::kRock, "roof");
  lattice.add_surfaces(lattice.layers());
  builder.begin_part(PartKind::kWall, Material::kRock, "walls");
  lattice.add_walls();
  return builder.take();
}

}  // namespace adit

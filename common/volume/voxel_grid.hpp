// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cmath>
#include <cstdint>
#include <optional>

#include <Eigen/Core>

namespace adit {

/// Index of a cell on the Morton curve through a cube of 2^16 cells a side: the bits of the keys of
/// x, y and z interleaved, x lowest. An octree stores its leaves in this order: a node at any depth
/// is an interval of the curve.
using VoxelCode = std::uint64_t;

/// Depth of the tree, from the root to the smallest cells.
inline constexpr int kVoxelDepth = 16;

/// Number of cells in a node at a depth.
constexpr VoxelCode cells_of_node(int depth) {
  return VoxelCode{1} << static_cast<unsigned>(3 * (kVoxelDepth - depth));
}

/// Inserts two zero bits between the 16 bits of a key.
constexpr VoxelCode spread_bits(std::uint32_t key) {
  VoxelCode code = key & 0xFFFFU;
  code = (code | (code << 16U)) & 0x0000FF0000FFU;
  code = (code | (code << 8U)) & 0x00F00F00F00FU;
  code = (code | (code << 4U)) & 0x0C30C30C30C3U;
  return (code | (code << 2U)) & 0x249249249249U;
}

/// The inverse of spread_bits(); bits of other axes are ignored.
constexpr std::uint32_t gather_bits(VoxelCode code) {
  code &= 0x249249249249U;
  code = (code | (code >> 2U)) & 0x0C30C30C30C3U;
  code = (code | (code >> 4U)) & 0x00F00F00F00FU;
  code = (code | (code >> 8U)) & 0x0000FF0000FFU;
  return static_cast<std::uint32_t>((code | (code >> 16U)) & 0xFFFFU);
}

/// Voxels around the origin of a frame, with OctoMap's keys: the key of the cell that begins at the
/// origin is 2^15 on each axis.
class VoxelGrid {
 public:
  static constexpr int kKeyOfOrigin = 32768;
  using Keys = Eigen::Vector3i;

  /// `cell_m`: side of a cell [m].
  explicit VoxelGrid(double cell_m) : cell_m_(cell_m), cells_per_m_(1.0 / cell_m) {}

  [[nodiscard]] double cell_m() const { return cell_m_; }

  /// Keys of a point; empty for a point outside the cube or not finite.
  [[nodiscard]] std::optional<Keys> keys_of(const Eigen::Vector3f& p) const {
    Keys keys;
    for (int i = 0; i < 3; ++i) {
      const double key = std::floor(cells_per_m_ * static_cast<double>(p[i])) + kKeyOfOrigin;
      if (!(key >= 0.0 && key < 2.0 * kKeyOfOrigin)) return std::nullopt;
      keys[i] = static_cast<int>(key);
    }
    return keys;
  }

  static VoxelCode code_of(const Keys& keys) {
    return spread_bits(static_cast<std::uint32_t>(keys.x())) |
           spread_bits(static_cast<std::uint32_t>(keys.y())) << 1U |
           spread_bits(static_cast<std::uint32_t>(keys.z())) << 2U;
  }

  static Keys keys_at(VoxelCode code) {
    return {static_cast<int>(gather_bits(code)), static_cast<int>(gather_bits(code >> 1U)),
            static_cast<int>(gather_bits(code >> 2U))};
  }

  /// Centre of a cell on one axis [m].
  [[nodiscard]] double centre_m(int key) const {
    return (static_cast<double>(key - kKeyOfOrigin) + 0.5) * cell_m_;
  }

  /// Centre of a cell [m].
  [[nodiscard]] Eigen::Vector3d centre_m(const Keys& keys) const {
    return {centre_m(keys.x()), centre_m(keys.y()), centre_m(keys.z())};
  }

 private:
  double cell_m_;
  double cells_per_m_;
};

}  // namespace adit
